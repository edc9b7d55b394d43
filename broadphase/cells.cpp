// SPDX-License-Identifier: MIT
#include "broadphase/cells.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace throng::broadphase {

namespace {

constexpr double kSmallestCell = 1e-300;  // m; its inverse is still finite

/// The width of a cell along an axis. A cell number, an offset from the origin times a factor, is off by at
/// most 1.5 epsilon times the number of cells, for either of two points; their computed distance by less than
/// 4 epsilon of itself. 8 epsilon of the whole extent is more than all of that.
double cell_width(double least, double extent) {
  return std::max(least + 8.0 * std::numeric_limits<double>::epsilon() * (extent + 4.0 * least),
                  kSmallestCell);
}

}  // namespace

void Cells::fit(const Point& low, const Point& high, double least_size, std::size_t items,
                const Period* period) {
  assert(least_size >= 0.0);
  periodic_ = period != nullptr;
  origin_ = period ? period->origin : low;
  extent_ = period ? period->size : Point(high - low);
  assert(extent_.allFinite() && extent_.minCoeff() >= 0.0);
  // One width for both axes: square cells, and a margin that suits the longer side.
  const double width = cell_width(least_size, extent_.maxCoeff());
  std::int64_t count[2];
  for (int axis = 0; axis < 2; ++axis) {
    count[axis] = static_cast<std::int64_t>(extent_[axis] / width);
    per_cell_[axis] = 1.0 / width;
    if (!period) {
      ++count[axis];
    } else {
      if (count[axis] < 3) count[axis] = 1;
      per_cell_[axis] = static_cast<double>(count[axis]) / extent_[axis];
    }
  }
  columns_ = count[0];
  rows_ = count[1];
  choose_table(items);
}

void Cells::choose_table(std::size_t items) {
  const std::int64_t most = 4 * static_cast<std::int64_t>(items) + 64;
  shared_ = columns_ > most || rows_ > most || columns_ * rows_ > most;
  if (!shared_) {
    stride_ = columns_;
    buckets_ = static_cast<std::size_t>(columns_ * rows_);
    return;
  }
  const std::uint64_t stretch = std::bit_ceil(std::max<std::uint64_t>(items, 16));
  mask_ = stretch - 1;
  stretch_bits_ = std::countr_zero(stretch);
  buckets_ = 2 * stretch;
}

}  // namespace throng::broadphase
