// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/point.h"

/// An order of points in which those that follow one another are near one another: along the curve of
/// Hilbert (1891), as Kamel and Faloutsos pack trees ("On Packing R-trees", 1993).
namespace throng::broadphase {

class SpatialOrder {
 public:
  /// Replaces `order` by the rows of `points` along the curve; points that coincide by row. However unequal
  /// the cloud: what is too dense for the curve's 2^16 steps a side gets a curve of its own. Expects finite
  /// points, fewer than 2^32 - 1 of them. O(n) for a cloud of one scale, O(n s) for one of s scales that are
  /// 2^16 apart; allocates only to grow.
  void sort(std::span<const Point> points, std::vector<std::uint32_t>& order);

 private:
  void sort(std::span<const Point> points, std::span<std::uint64_t> items);
  void sort_by_key(std::span<std::uint64_t> items);

  std::vector<std::uint64_t> items_, other_;  // place along the curve in the upper half, row in the lower
};

}  // namespace throng::broadphase
