// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>

#include "broadphase/point.h"

namespace throng::broadphase {

/// What pairs are sought of: points within one reach, discs, or boxes; and what makes two of them a pair.
struct Items {
  std::span<const Point> points;       ///< m; of boxes none
  double same_reach = 0.0;             ///< m: for points, how far apart two may be
  std::span<const double> reach = {};  ///< m: for discs, how far each reaches
  std::span<const Eigen::AlignedBox2d> boxes = {};
  const Period* period = nullptr;  ///< not for boxes

  std::size_t size() const { return boxes.empty() ? points.size() : boxes.size(); }

  /// Where an item stands: a box at its lower left corner.
  const Point& place(std::size_t row) const { return boxes.empty() ? points[row] : boxes[row].min(); }

  /// The definition of a pair, in double.
  bool near(std::uint32_t a, std::uint32_t b) const {
    if (!boxes.empty()) return boxes[a].intersects(boxes[b]);
    const double most = reach.empty() ? same_reach : reach[a] + reach[b];
    return squared_distance(points[a], points[b], period) <= most * most;
  }
};

}  // namespace throng::broadphase
