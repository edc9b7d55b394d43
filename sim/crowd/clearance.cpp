// SPDX-License-Identifier: MIT
#include "sim/crowd/clearance.h"

#include <algorithm>
#include <cmath>

namespace throng {

namespace {

constexpr double kCellRounding = 1e-6;  // of a cell: more than float and the way to its number are off by

}  // namespace

Clearance::Clearance(const broadphase::BoxIndex& index, const Eigen::AlignedBox2d& bounds, double cell) {
  if (bounds.isEmpty()) return;
  const Vec size = bounds.sizes();
  const double most = std::sqrt(kMostCells) - 1.0;
  cell =
      std::max({cell, size.maxCoeff() / kMostCells * 2.0, std::sqrt(size.x()) * std::sqrt(size.y()) / most});
  if (!(cell > 0.0 && std::isfinite(1.0 / cell))) return;
  low_ = bounds.min();
  per_cell_ = 1.0 / cell;
  columns_ = static_cast<int>(size.x() * per_cell_) + 1, rows_ = static_cast<int>(size.y() * per_cell_) + 1;
  clear_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 1e30f);
  const Vec rim = Vec::Constant(kCellRounding * cell + 1e-12 * bounds.max().cwiseAbs().maxCoeff());
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x) {
      const Vec corner = low_ + cell * Vec(x, y);
      float& clear = clear_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(x)];
      index.for_each_near({Vec(corner - rim), Vec(corner + Vec(cell, cell) + rim)},
                          [&](std::uint32_t) { clear = 0.0f; });
    }
  spread();
  for (float& clear : clear_)
    clear = static_cast<float>(std::max(0.0, (clear - 1.0) * cell * (1.0 - 4.0 * kCellRounding)));
}

/// From 0 where something is: to how many cells it is at least, diagonally or straight.
void Clearance::spread() {
  const auto at = [&](int x, int y) -> float& {
    return clear_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(x)];
  };
  const auto from = [&](int x, int y, int other_x, int other_y) {
    if (other_x < 0 || other_y < 0 || other_x >= columns_ || other_y >= rows_) return;
    at(x, y) = std::min(at(x, y), at(other_x, other_y) + 1.0f);
  };
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x)
      from(x, y, x - 1, y - 1), from(x, y, x, y - 1), from(x, y, x + 1, y - 1), from(x, y, x - 1, y);
  for (int y = rows_ - 1; y >= 0; --y)
    for (int x = columns_ - 1; x >= 0; --x)
      from(x, y, x + 1, y + 1), from(x, y, x, y + 1), from(x, y, x - 1, y + 1), from(x, y, x + 1, y);
}

}  // namespace throng
