// SPDX-License-Identifier: MIT
#include "tools/bench/plain_grid.h"

#include <algorithm>

namespace throng::bench {

using broadphase::Pair;
using broadphase::PairBuffer;
using broadphase::Point;

void PlainGrid::sort(std::span<const Point> points, double reach, std::span<const double> radii) {
  Point low = points[0], high = points[0];
  for (const Point& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double per_cell = (1.0 - 1e-9) / reach;
  columns_ = static_cast<std::size_t>((high.x() - low.x()) * per_cell) + 1;
  rows_of_cells_ = static_cast<std::size_t>((high.y() - low.y()) * per_cell) + 1;
  start_.assign(columns_ * rows_of_cells_ + 1, 0);
  cell_.resize(points.size());
  for (std::size_t row = 0; row < points.size(); ++row) {
    const auto x = static_cast<std::uint32_t>((points[row].x() - low.x()) * per_cell);
    const auto y = static_cast<std::uint32_t>((points[row].y() - low.y()) * per_cell);
    cell_[row] = static_cast<std::uint32_t>(columns_) * y + x;
    ++start_[cell_[row]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& start : start_) start = sum += start;
  point_.resize(points.size());
  row_.resize(points.size());
  if (!radii.empty()) radius_.resize(points.size());
  for (std::size_t row = points.size(); row-- > 0;) {
    const std::uint32_t place = --start_[cell_[row]];
    point_[place] = points[row];
    row_[place] = static_cast<std::uint32_t>(row);
    if (!radii.empty()) radius_[place] = radii[row];
  }
}

/// Writes each candidate and keeps it by counting on: faster than push_back behind a branch that nobody can
/// foretell.
template <class Most>
void PlainGrid::gather(const Most& most, PairBuffer& pairs) const {
  for (std::size_t y = 0; y < rows_of_cells_; ++y) {
    const std::uint32_t* own = start_.data() + y * columns_;
    const bool last = y + 1 == rows_of_cells_;
    for (std::size_t x = 0; x < columns_; ++x) {
      const std::size_t left = x > 0 ? x - 1 : 0, right = std::min(x + 2, columns_);
      const std::uint32_t begin = last ? 0 : own[columns_ + left], end = last ? 0 : own[columns_ + right];
      for (std::uint32_t i = own[x]; i < own[x + 1]; ++i) {
        Pair* out = pairs.room(own[right] - i + end - begin);
        const Point p = point_[i];
        const std::uint32_t row = row_[i];
        const auto meet = [&](std::uint32_t j) {
          const double dx = p.x() - point_[j].x(), dy = p.y() - point_[j].y();
          *out = {std::min(row, row_[j]), std::max(row, row_[j])};
          out += dx * dx + dy * dy <= most(i, j);
        };
        for (std::uint32_t j = i + 1; j < own[right]; ++j) meet(j);
        for (std::uint32_t j = begin; j < end; ++j) meet(j);
        pairs.keep(out);
      }
    }
  }
}

void PlainGrid::find(std::span<const Point> points, double reach, std::span<const double> radii,
                     PairBuffer& pairs) {
  sort(points, reach, radii);
  pairs.clear();
  if (radii.empty())
    gather([most = reach * reach](std::uint32_t, std::uint32_t) { return most; }, pairs);
  else
    gather(
        [this](std::uint32_t i, std::uint32_t j) {
          const double sum = radius_[i] + radius_[j];
          return sum * sum;
        },
        pairs);
}

}  // namespace throng::bench
