// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "broadphase/box_index.h"
#include "sim/crowd/clearance.h"
#include "sim/crowd/region.h"

/// What agents can't walk through, as one set of segments: the edges of the walkable area, walls and the
/// domain's box, and bodies that move.
namespace throng {

/// A line of points that agents can't cross.
struct BarrierLine {
  std::vector<Vec> points;  ///< m, two or more
  bool closed = false;
};

class Barriers {
 public:
  struct Segment {
    Vec a, b;            ///< m
    std::uint32_t at_a;  ///< which end is the next one at `a`; its own where none is
    std::uint32_t at_b;  ///< likewise

    const Vec& end(std::uint32_t which) const { return which % 2 == 0 ? a : b; }
  };

  /// `reach` (m): how far will mostly be looked; it decides speed, never answers. Segments that are the same
  /// count once. O(n log n).
  Barriers(std::span<const BarrierLine> lines, double reach);

  /// Those that stand still.
  std::span<const Segment> segments() const { return std::span(segments_).first(still_); }

  /// Adds lines until the next call, which are found too from now on, one by one: O(their segments) for each
  /// question near one of them.
  void set_moving(std::span<const BarrierLine> lines);

  /// Calls f(point) for each place at most `reach` from `p` at which the distance to the barriers has a local
  /// minimum: of a corner that sticks out its tip, once; of a corner to stand in a place on each side; of a
  /// curve in many pieces its nearest place alone, be they of one line or of several that meet. In the order
  /// of the segments. O(segments near). Allocates nothing.
  template <class F>
  void for_each_nearest(const Vec& p, double reach, F&& f) const;

  /// Calls f(segment) for each that stands still and touches the box, ascending, but before those for each of
  /// the lines that move whose box touches it.
  template <class F>
  void for_each_near(const Eigen::AlignedBox2d& box, F&& f) const {
    for (const Moving& line : moving_)
      if (line.box.intersects(box))
        for (std::size_t row = line.first; row < line.end; ++row) f(segments_[row]);
    const Vec half = 0.5 * (box.max() - box.min());
    const double clear = clearance_.at(box.min() + half);
    if (clear * clear > half.squaredNorm()) return;
    index_.for_each_near(box, [&](std::uint32_t row) { f(segments_[row]); });
  }

  /// m: none is nearer to `p`, though they may all be much farther. O(lines that move).
  double clear(const Vec& p) const {
    double clear = clearance_.at(p);
    for (const Moving& line : moving_) clear = std::min(clear, line.box.exteriorDistance(p));
    return clear;
  }

  /// Asks for the memory that `clear` will read of `p`.
  void prefetch(const Vec& p) const { clearance_.prefetch(p); }

  /// Whether the straight way from `p` to `q` meets a segment, be it by touching. Exact.
  bool block(const Vec& p, const Vec& q) const;

  /// Whether a disc of that radius (m) gets straight on from `p` to `q`: it comes nowhere nearer to a segment
  /// than its radius, but to one that it is as near to at one of the ends. Crossing none is exact.
  bool leave_room(const Vec& p, const Vec& q, double radius) const;

  /// m, from `p` to the nearest segment; `most` where that is farther.
  double distance(const Vec& p, double most) const;

 private:
  /// Of its ends: 2 row + 0 for `a` and + 1 for `b`. Those at one place make a ring.
  std::uint32_t next(std::uint32_t end) const {
    const Segment& segment = segments_[end / 2];
    return end % 2 == 0 ? segment.at_a : segment.at_b;
  }

  /// Whether the nearest point of the segment is a local minimum over all that meet there, and for this one
  /// of them to tell: the first that begins there, else the first.
  bool is_minimum(std::uint32_t row, const Vec& nearest, const Vec& p) const;

  struct Moving {
    std::size_t first, end;  ///< of the segments
    Eigen::AlignedBox2d box;
  };

  void add(const BarrierLine& line);
  void drop_repeated();
  void join();

  std::vector<Segment> segments_;  // those that move behind those that stand still
  std::size_t still_ = 0;
  std::vector<Moving> moving_;
  broadphase::BoxIndex index_;
  Clearance clearance_;
};

inline bool Barriers::is_minimum(std::uint32_t row, const Vec& nearest, const Vec& p) const {
  const Segment& segment = segments_[row];
  if (nearest != segment.a && nearest != segment.b) return true;
  const std::uint32_t own = 2 * row + (nearest == segment.a ? 0 : 1);
  const auto rank = [](std::uint32_t end) { return std::pair(end % 2, end / 2); };
  for (std::uint32_t end = next(own); end != own; end = next(end)) {
    const Vec along = nearest - segments_[end / 2].end(end + 1);
    if (rank(end) < rank(own) || !((p - nearest).dot(along) >= 0.0)) return false;
  }
  return true;
}

template <class F>
void Barriers::for_each_nearest(const Vec& p, double reach, F&& f) const {
  const Vec far(reach, reach);
  for_each_near({Vec(p - far), Vec(p + far)}, [&](const Segment& segment) {
    const Vec nearest = nearest_on_segment(segment.a, segment.b, p);
    const auto row = static_cast<std::uint32_t>(&segment - segments_.data());
    if ((nearest - p).squaredNorm() <= reach * reach && is_minimum(row, nearest, p)) f(nearest);
  });
}

}  // namespace throng
