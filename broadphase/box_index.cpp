// SPDX-License-Identifier: MIT
#include "broadphase/box_index.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace throng::broadphase {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kManyCells = 1024.0;      // an extent with more is large
constexpr std::size_t kLeastItems = 4096;  // so that an empty hall of 128 by 128 cells needs no hashing
constexpr std::size_t kFewLarge = 16;      // every question looks at all of these

/// About how many cells of a size an extent comes near, and at least that.
double cell_count(const Extent& extent, double size) {
  const Point cells = (extent.b - extent.a).cwiseAbs() / size;
  return extent.is_segment ? cells.x() + 3.0 * cells.y() + 8.0 : (cells.x() + 2.0) * (cells.y() + 2.0);
}

double typical_size(std::span<const Extent> extents, const Box& bounds) {
  double sum = 0.0;
  for (const Extent& extent : extents) sum += (extent.b - extent.a).cwiseAbs().maxCoeff();
  const double count = static_cast<double>(extents.size());
  return sum > 0.0 ? sum / count : bounds.sizes().maxCoeff() / std::sqrt(count);
}

}  // namespace

/// Separating axes (Gottschalk 1996): the box's two, and for a segment its normal.
bool touches(const Extent& extent, const Box& box) {
  if (!extent.box().intersects(box)) return false;
  if (!extent.is_segment) return true;
  const Point d = extent.b - extent.a, low = box.min() - extent.a, high = box.max() - extent.a;
  const double y1 = d.x() * low.y(), y2 = d.x() * high.y(), x1 = d.y() * low.x(), x2 = d.y() * high.x();
  const double largest = std::max(std::abs(y1), std::abs(y2)) + std::max(std::abs(x1), std::abs(x2));
  const double slack = 8.0 * kEpsilon * largest + std::numeric_limits<double>::min();
  return std::min(y1, y2) - std::max(x1, x2) <= slack && std::max(y1, y2) - std::min(x1, x2) >= -slack;
}

void BoxIndex::build(std::span<const Extent> extents, double query_size) {
  assert(extents.size() < std::size_t{1} << 31 && query_size >= 0.0);
  extents_.assign(extents.begin(), extents.end());
  large_.clear();
  bounds_.setEmpty();
  for (const Extent& extent : extents_) bounds_.extend(extent.box());
  if (extents_.empty()) return;
  assert(bounds_.min().allFinite() && bounds_.max().allFinite());
  fill_cells(choose_cell_size(query_size));
}

/// The query's size, doubled until the memory is in proportion. Returns about how many entries there will be.
double BoxIndex::choose_cell_size(double query_size) {
  const double least = 16.0 * kEpsilon * bounds_.sizes().maxCoeff() + std::numeric_limits<double>::min();
  cell_size_ = std::max(query_size > 0.0 ? query_size : typical_size(extents_, bounds_), least);
  const double most = 16.0 * static_cast<double>(extents_.size()) + 4096.0;
  for (;; cell_size_ *= 2.0) {
    double entries = 0.0;
    std::size_t large = 0;
    for (const Extent& extent : extents_) {
      const double count = cell_count(extent, cell_size_);
      if (count > kManyCells)
        ++large;
      else
        entries += count;
    }
    if (entries <= most && large <= kFewLarge) return entries;
  }
}

/// A counting sort by bucket, in order of rows.
void BoxIndex::fill_cells(double entries) {
  const auto items = std::max(kLeastItems, static_cast<std::size_t>(entries / 2.0));
  cells_.fit(bounds_.min(), bounds_.max(), cell_size_, items, nullptr);
  start_.assign(cells_.buckets() + 1, 0);
  for (std::uint32_t row = 0; row < extents_.size(); ++row) {
    if (cell_count(extents_[row], cell_size_) > kManyCells)
      large_.push_back(row);
    else
      for_each_bucket(extents_[row], [this](std::size_t bucket) { ++start_[bucket]; });
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& start : start_) start = sum += start;
  rows_.resize(sum);
  std::size_t large = large_.size();
  for (auto row = static_cast<std::uint32_t>(extents_.size()); row-- > 0;) {
    if (large > 0 && large_[large - 1] == row)
      --large;
    else
      for_each_bucket(extents_[row], [this, row](std::size_t bucket) { rows_[--start_[bucket]] = row; });
  }
}

/// The buckets of all cells that an extent comes near. Where cells share a bucket it may come twice:
/// harmless, since who reads it takes equal rows together.
template <class F>
void BoxIndex::for_each_bucket(const Extent& extent, F&& f) const {
  const auto visit = [&](const Run& run) {
    for (std::size_t bucket = run.bucket; bucket < run.end_bucket; ++bucket) f(bucket);
  };
  const Box box = extent.box();
  Range range;
  cells_.range(box.min(), box.max(), range);
  if (!extent.is_segment || range.first.y == range.last.y || range.first.x == range.last.x) {
    cells_.for_each_run(range, visit);
    return;
  }
  // Row by row, between the points where the segment enters and leaves the row, each pushed outward by the
  // rounding.
  const Point d = extent.b - extent.a;
  const double slope = d.x() / d.y();
  const double slack =
      32.0 * kEpsilon * (bounds_.min().cwiseAbs() + bounds_.max().cwiseAbs() + bounds_.sizes()).maxCoeff();
  const auto x_at = [&](double y) {
    return std::clamp(extent.a.x() + (y - extent.a.y()) * slope, box.min().x(), box.max().x());
  };
  for (std::int64_t y = range.first.y; y <= range.last.y; ++y) {
    const double bottom = bounds_.min().y() + static_cast<double>(y) * cells_.width();
    const double x1 = x_at(bottom - slack), x2 = x_at(bottom + cells_.width() + slack);
    Range row;
    if (cells_.range({std::min(x1, x2) - slack, box.min().y()}, {std::max(x1, x2) + slack, box.max().y()},
                     row))
      cells_.for_each_run(y, row.first.x, row.last.x, visit);
  }
}

}  // namespace throng::broadphase
