// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "broadphase/neighbours.h"
#include "broadphase/point.h"

/// Who is near whom, of all points at once: the lists that sensing within a radius needs. Each list is that
/// of `find_near`, to the last bit; for views, groups, the few nearest, or other places ask `neighbours.h`.
namespace throng::broadphase {

class AllLists {
 public:
  /// Expects threads >= 1; with one, everything runs in the caller's.
  explicit AllLists(int threads = 1);
  ~AllLists();
  AllLists(AllLists&&) noexcept;
  AllLists& operator=(AllLists&&) noexcept;

  /// Replaces list i of `lists` by all other points at most `radius` (m, >= 0, may be infinite) from point i,
  /// ascending by (distance, row), in a periodic domain each at its nearest image, however large the radius.
  /// The answer is the same for any number of threads.
  ///
  /// O(n + candidates) in a grid as wide as the radius: nine cells hold about three times the answers. Clouds
  /// too scattered for an array of such cells are asked by a `ProximityTree`, up to three times slower.
  /// Expects points as `ProximityTree::build` does, but fewer than 2^30. Allocates only to grow.
  void find(std::span<const Point> points, double radius, const Period* period, NeighbourLists& lists);

  /// The same where point i looks radius[i] (m, >= 0) far. In a grid as wide as the largest, if the radii are
  /// alike: if their mean square is at least a quarter of the largest's, both among all points and with each
  /// point counted once for each that shares its cell. Then the candidates are in proportion to the answers.
  void find(std::span<const Point> points, std::span<const double> radius, const Period* period,
            NeighbourLists& lists);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace throng::broadphase
