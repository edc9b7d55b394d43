// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "broadphase/box_index.h"
#include "sim/crowd/region.h"
#include "sim/prefetch.h"

namespace throng {

/// At least how far it is to the nearest of what stands still, from anywhere, in one look: most agents are
/// far from all walls, and need not ask who is near.
class Clearance {
 public:
  Clearance() = default;

  /// Over these bounds, in cells of `cell` (m) or larger ones, so that they are not many more than
  /// kMostCells. O(cells).
  Clearance(const broadphase::BoxIndex& index, const Eigen::AlignedBox2d& bounds, double cell);

  /// m: nothing is nearer to `p`. 0 outside the bounds. O(1).
  double at(const Vec& p) const {
    std::size_t cell;
    return locate(p, cell) ? clear_[cell] : 0.0;
  }

  /// Asks for the memory that `at` will read of `p`.
  void prefetch(const Vec& p) const {
    if (std::size_t cell; locate(p, cell)) throng::prefetch(&clear_[cell]);
  }

  static constexpr double kMostCells = 65536.0;

 private:
  void spread();
  bool locate(const Vec& p, std::size_t& cell) const {
    const Vec place = (p - low_) * per_cell_;
    if (!(place.x() >= 0.0 && place.y() >= 0.0 && place.x() < columns_ && place.y() < rows_)) return false;
    const auto row = static_cast<std::size_t>(place.y()), column = static_cast<std::size_t>(place.x());
    cell = row * static_cast<std::size_t>(columns_) + column;
    return true;
  }

  Vec low_{0.0, 0.0};
  double per_cell_ = 0.0;  // 1/m
  int columns_ = 0, rows_ = 0;
  std::vector<float> clear_;  // m
};

}  // namespace throng
