// SPDX-License-Identifier: MIT
#include "broadphase/point_grid.h"

#include <array>
#include <cassert>
#include <limits>

namespace throng::broadphase {

namespace {

/// The reach of a pair, given as places in the grid's order.
struct OneReach {
  double reach;
  double operator()(std::size_t, std::size_t) const { return reach; }
};
struct SumOfReaches {
  const double* reach;
  double operator()(std::size_t i, std::size_t j) const { return reach[i] + reach[j]; }
};

/// The runs of cells in which the partners of one cell's points lie: half of the nine, so that each pair is
/// met once. The first run begins with the cell itself, and there only the points behind a point are its
/// partners.
struct HalfBlock {
  std::array<Run, 8> runs;
  int count = 0;

  void gather(const Cells& cells, const Cell& cell) {
    count = 0;
    const bool wraps = cells.periodic() && cells.columns() > 1;
    const std::int64_t left = wraps || cell.x > 0 ? cell.x - 1 : 0;
    const std::int64_t right = wraps || cell.x + 1 < cells.columns() ? cell.x + 1 : cell.x;
    const auto add = [this](const Run& run) { runs[static_cast<std::size_t>(count++)] = run; };
    cells.for_each_run(cell.y, cell.x, right, add);
    if (cell.y + 1 < cells.rows())
      cells.for_each_run(cell.y + 1, left, right, add);
    else if (cells.periodic() && cells.rows() > 1)
      cells.for_each_run(0, left, right, add);
  }
};

}  // namespace

void PointGrid::rebuild(std::span<const Point> points, double cell_size, const Period* period) {
  assert(points.size() < std::size_t{1} << 31);
  cell_size_ = cell_size;
  period_ = period != nullptr;
  if (period) period_size_ = period->size;
  Point low = points.empty() ? Point(0.0, 0.0) : points[0], high = low;
  for (const Point& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  assert(low.allFinite() && high.allFinite());
  assert(!period || points.empty() ||
         ((low.array() >= period->origin.array()).all() &&
          (high.array() <= (period->origin + period->size).array()).all()));
  cells_.fit(low, high, cell_size, points.size(), period);
  sort_into_cells(points);
}

/// A counting sort by bucket, stable: within a bucket rows ascend.
void PointGrid::sort_into_cells(std::span<const Point> points) {
  start_.assign(cells_.buckets() + 1, 0);
  bucket_.resize(points.size());
  for (std::size_t row = 0; row < points.size(); ++row) {
    bucket_[row] = static_cast<std::uint32_t>(cells_.bucket(cells_.cell(points[row])));
    ++start_[bucket_[row]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& start : start_) start = sum += start;
  points_.resize(points.size());
  rows_.resize(points.size());
  for (std::size_t row = points.size(); row-- > 0;) {
    const std::uint32_t place = --start_[bucket_[row]];
    points_[place] = points[row];
    rows_[place] = static_cast<std::uint32_t>(row);
  }
}

void PointGrid::find_pairs(double reach, std::vector<Pair>& pairs) {
  assert(0.0 <= reach && reach <= cell_size_);
  assert(!period_ || reach <= 0.5 * period_size_.minCoeff());
  found_.clear();
  gather(OneReach{reach}, found_);
  sorter_.sort(found_.pairs(), points_.size(), pairs);
}

void PointGrid::find_pairs(std::span<const double> reach, std::vector<Pair>& pairs) {
  found_.clear();
  gather_pairs(reach, found_);
  sorter_.sort(found_.pairs(), points_.size(), pairs);
}

void PointGrid::gather_pairs(std::span<const double> reach, PairBuffer& found) {
  assert(reach.size() == points_.size());
  reach_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    reach_[i] = reach[rows_[i]];
    assert(0.0 <= reach_[i] && 2.0 * reach_[i] <= cell_size_);
    assert(!period_ || 2.0 * reach_[i] <= 0.5 * period_size_.minCoeff());
  }
  gather(SumOfReaches{reach_.data()}, found);
}

template <class Reach>
void PointGrid::gather(const Reach& reach, PairBuffer& found) const {
  if (period_ && cells_.shared())
    gather<true>(PeriodicMetric{period_size_}, reach, found);
  else if (period_)
    gather<false>(PeriodicMetric{period_size_}, reach, found);
  else if (cells_.shared())
    gather<true>(PlaneMetric{}, reach, found);
  else
    gather<false>(PlaneMetric{}, reach, found);
}

template <bool kShared, class Metric, class Reach>
void PointGrid::gather(const Metric& metric, const Reach& reach, PairBuffer& found) const {
  Cell cell{-1, -1};
  HalfBlock block;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const Point p = points_[i];
    const std::uint32_t row = rows_[i];
    if (const Cell own = cells_.cell(p); own != cell) block.gather(cells_, cell = own);
    std::uint32_t begin = i + 1;  // the points behind this one, in its own run
    for (int k = 0; k < block.count; ++k) {
      const Run& run = block.runs[static_cast<std::size_t>(k)];
      if (k > 0) begin = start_[run.bucket];
      const std::uint32_t end = start_[run.end_bucket];
      if (begin >= end) continue;
      Pair* out = found.room(end - begin);
      for (std::uint32_t j = begin; j < end; ++j) {
        const double most = reach(i, j);
        bool near = metric(p, points_[j]) <= most * most;
        if constexpr (kShared) near = near && run.holds(cells_.cell(points_[j]));
        const std::uint32_t other = rows_[j];
        *out = {row < other ? row : other, row < other ? other : row};  // overwritten unless kept: no branch
        out += near;
      }
      found.keep(out);
    }
  }
}

}  // namespace throng::broadphase
