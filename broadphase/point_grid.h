// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/cells.h"
#include "broadphase/pairs.h"
#include "broadphase/point.h"

/// Who is near whom, among points: a uniform grid of square cells, hashed, so that it costs memory in
/// proportion to the points and never to the area. For discs of very different radii use `DiscPairs`, for
/// long or large static things `BoxIndex`, for the nearest few `neighbours.h`.
///
/// Two points are at most r apart where their squared distance, computed in double by `squared_distance`, is
/// at most r * r: that, and not the real number behind it, is what every answer here agrees with, to the last
/// bit. Expects coordinates of at most 1e150 m, and fewer than 2^31 points.
namespace throng::broadphase {

class PointGrid {
 public:
  /// Indexes a copy of `points` in cells a hair wider than `cell_size` (m, >= 0). O(n); allocates only to
  /// grow. Expects finite points, in a periodic domain inside it. With a period distances are those of the
  /// nearest images.
  void rebuild(std::span<const Point> points, double cell_size, const Period* period = nullptr);

  /// Replaces `pairs` by all rows a < b that are at most `reach` (m) apart, ascending.
  /// Expects 0 <= reach <= cell_size(), and reach <= half the period. O(n k), k = mean number of points in
  /// nine cells; allocates only to grow.
  void find_pairs(double reach, std::vector<Pair>& pairs);

  /// Replaces `pairs` by all rows a < b with |p_a - p_b| <= reach[a] + reach[b] (m), ascending.
  /// Expects 2 max(reach) <= cell_size(), and 2 max(reach) <= half the period.
  void find_pairs(std::span<const double> reach, std::vector<Pair>& pairs);

  /// Appends the pairs of the second `find_pairs` to `found`, in an order that depends on the points only.
  void gather_pairs(std::span<const double> reach, PairBuffer& found);

  /// Calls `f(row, squared_distance)` once for every point at most `radius` (m, may be infinite) from `p`, in
  /// an order that depends on the points only. `p` may lie anywhere, in a periodic domain inside it; any
  /// radius, there too, since each point has one nearest image. O(cells within reach + points in them), at
  /// most O(n); allocates nothing.
  template <class F>
  void for_each_near(const Point& p, double radius, F&& f) const {
    if (period_)
      for_each_near(p, radius, PeriodicMetric{period_size_}, f);
    else
      for_each_near(p, radius, PlaneMetric{}, f);
  }

  double cell_size() const { return cell_size_; }  ///< m, as asked for
  std::size_t size() const { return points_.size(); }

  /// The indexed points in the order of their cells, which is good to walk in, and the row that each came
  /// from.
  std::span<const Point> sorted_points() const { return points_; }
  std::span<const std::uint32_t> sorted_rows() const { return rows_; }

 private:
  template <class Metric, class F>
  void for_each_near(const Point& p, double radius, const Metric& metric, F& f) const;

  template <class Reach>
  void gather(const Reach& reach, PairBuffer& found) const;
  template <bool kShared, class Metric, class Reach>
  void gather(const Metric& metric, const Reach& reach, PairBuffer& found) const;
  void sort_into_cells(std::span<const Point> points);

  Cells cells_;
  double cell_size_ = 0.0;
  bool period_ = false;
  Point period_size_{0.0, 0.0};
  std::vector<std::uint32_t> start_;   // per bucket, and one more: where its points begin
  std::vector<std::uint32_t> bucket_;  // per row
  std::vector<Point> points_;          // by bucket, then row
  std::vector<std::uint32_t> rows_;
  std::vector<double> reach_;  // of the points, in their order
  PairBuffer found_;
  PairSorter sorter_;
};

template <class Metric, class F>
void PointGrid::for_each_near(const Point& p, double radius, const Metric& metric, F& f) const {
  const double most = radius * radius;
  const auto visit = [&](std::uint32_t i) {
    const double squared = metric(points_[i], p);
    if (squared <= most) f(rows_[i], squared);
  };
  Range range;
  if (points_.empty() || !cells_.range(p, radius, range)) return;
  if (range.count() > 2.0 * static_cast<double>(points_.size()) + 16.0) {
    for (std::uint32_t i = 0; i < points_.size(); ++i) visit(i);
    return;
  }
  cells_.for_each_run(range, [&](const Run& run) {
    for (std::uint32_t i = start_[run.bucket]; i < start_[run.end_bucket]; ++i)
      if (!cells_.shared() || run.holds(cells_.cell(points_[i]))) visit(i);
  });
}

}  // namespace throng::broadphase
