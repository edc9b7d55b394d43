// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "broadphase/proximity_tree.h"

/// Who is near a place, who is nearest, and who of those is seen: for sensing, and for questions asked from
/// outside. For all pairs within one distance `AllPairs` is faster, for everyone's list within one
/// `AllLists`.
///
/// The distance of a point is the root of `squared_distance`, and it is within a radius r where that square
/// is at most r * r; that of a disc goes to its rim, |p - c| - r, below 0 inside; that of a box to its
/// nearest point, 0 inside. All are computed in double, without libm and without fused operations: each
/// answer has the same bits on every machine, whatever the SIMD width and the number of threads. In a
/// periodic domain each item is met once, at its nearest image, however large the radius.
namespace throng::broadphase {

struct Neighbour {
  std::uint32_t row;
  double distance;  ///< m
  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// How far to either side of a heading one sees, given by the cosine and the sine of half the whole angle,
/// which is above 0 and at most a full turn. Whoever turns an angle into these decides their last bits.
struct FieldOfView {
  double cos_half = -1.0, sin_half = 0.0;  ///< all around: a sine of 0

  bool all_around() const { return sin_half <= 0.0; }

  /// Whether what is `d` (m) away is seen by who heads for `heading` (of any length). The border is seen,
  /// as far as the two rounded products of the comparison are equal; so is what stands in the same place. A
  /// heading of zero sees all around.
  bool sees(const Point& heading, const Point& d) const {
    const double across = heading.x() * d.y() - heading.y() * d.x();
    const double ahead = heading.x() * d.x() + heading.y() * d.y();
    return all_around() || (across < 0.0 ? -across : across) * cos_half <= ahead * sin_half;
  }
};

/// What is asked for: of the rows in one of the wanted groups, in view and at most `radius` away the `most`
/// nearest. A point or a disc is in view where its centre is, a box where its nearest point is.
struct Near {
  double radius = std::numeric_limits<double>::infinity();     ///< m, >= 0
  std::size_t most = std::numeric_limits<std::size_t>::max();  ///< of equally near ones those of lower rows
  std::uint32_t groups = std::numeric_limits<std::uint32_t>::max();  ///< bits; a tree without groups: ignored
  FieldOfView view = {};
};

/// Where a question is asked.
struct Place {
  Point at{0.0, 0.0};          ///< m, anywhere in the plane; in a periodic domain inside it
  Point heading = {0.0, 0.0};  ///< for the view
  std::optional<std::uint32_t> except =
      {};  ///< a row that is left out, as who asks is among its own neighbours
};

/// Replaces `neighbours` by what is asked for, ascending by (distance, row). O(log n + k log k), k = the
/// answers; where `most` of many are asked for, or `groups` or `view` leave most out, those that are nearer
/// than the last one count too. Allocates only to grow.
void find_near(const ProximityTree& tree, const Place& place, const Near& near,
               std::vector<Neighbour>& neighbours);

/// Calls `f(row, distance)` for everything that is asked for, once each, in an order that depends on the
/// items only; `near.most` is ignored. Allocates nothing.
template <class F>
void for_each_near(const ProximityTree& tree, const Place& place, const Near& near, F&& f);

/// Many questions at once. All are of length 0 or of one length.
struct Places {
  std::span<const Point> at = {};         ///< m
  std::span<const Point> heading = {};    ///< for the view; empty: none
  std::span<const double> radius = {};    ///< m, of each; empty: that of `Near`
  std::optional<std::uint32_t> own = {};  ///< who asks place i is row *own + i, and is left out
};

/// The neighbours of place i stand in entries `begin[i]` to `begin[i + 1]`, ascending by (distance, row).
struct NeighbourLists {
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> row;
  std::vector<double> distance;  ///< m

  std::size_t size() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/// Asks for many places at once, faster than one by one: places near one another are asked one after the
/// other, whatever their order, and share part of the search. Keeps its memory from question to question.
class NeighbourSearch {
 public:
  NeighbourSearch();
  ~NeighbourSearch();
  NeighbourSearch(NeighbourSearch&&) noexcept;
  NeighbourSearch& operator=(NeighbourSearch&&) noexcept;

  /// Replaces `lists` by the answers of `find_near` for all places. `threads` >= 1: with one, everything
  /// runs in the caller's; the answer is the same for any number. Places that are rows cost O(tree.size())
  /// beside their answers. Takes the memory of the answers twice: ask for some 100,000 places at a time where
  /// that matters. Allocates only to grow.
  void find(const ProximityTree& tree, const Places& places, const Near& near, NeighbourLists& lists,
            int threads = 1);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

using NeighbourCall = void (*)(void* context, std::uint32_t row, double distance);
void for_each_near(const ProximityTree& tree, const Place& place, const Near& near, NeighbourCall call,
                   void* context);

template <class F>
void for_each_near(const ProximityTree& tree, const Place& place, const Near& near, F&& f) {
  using Function = std::remove_reference_t<F>;
  for_each_near(
      tree, place, near,
      [](void* context, std::uint32_t row, double distance) {
        (*static_cast<Function*>(context))(row, distance);
      },
      const_cast<void*>(static_cast<const void*>(&f)));
}

}  // namespace throng::broadphase
