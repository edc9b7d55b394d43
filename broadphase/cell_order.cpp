// SPDX-License-Identifier: MIT
#include "broadphase/cell_order.h"

#include <algorithm>
#include <cmath>

namespace throng::broadphase {

namespace {
constexpr double kMostMeetings = 4.0;  // a point, within the larger cells: a cloud spread evenly has 2
}  // namespace

bool CellOrder::rebuild(std::span<const Point> points, double radius, const Period* period, Team& team) {
  constexpr std::size_t kPart = 16384;  // points: enough work for a thread
  row_.resize(points.size() + kPadding);
  x_.resize(points.size() + kPadding);
  y_.resize(points.size() + kPadding);
  if (!choose_cells(points, radius, period)) return false;
  for (auto row = static_cast<std::uint32_t>(points.size()); row-- > 0;) row_[--start_[bucket_[row]]] = row;
  team.for_each((points.size() + kPart - 1) / kPart, [&](std::size_t part) {
    const std::size_t end = std::min((part + 1) * kPart, points.size());
    for (std::size_t i = part * kPart; i < end; ++i) {
      x_[i] = points[row_[i]].x();
      y_[i] = points[row_[i]].y();
    }
  });
  return true;
}

/// Where cells as wide as the radius are too many for an array, tries larger ones, about one a point.
bool CellOrder::choose_cells(std::span<const Point> points, double radius, const Period* period) {
  Point low = period ? period->origin : points[0], high = low;
  if (period) high += period->size;
  for (const Point& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  cells_.fit(low, high, radius, points.size(), period);
  if (!cells_.shared()) return count(points, false);
  const Point extent = high - low;
  const double n = static_cast<double>(points.size());
  cells_.fit(low, high, std::max({radius, std::sqrt(extent.x() / n * extent.y()), extent.maxCoeff() / n}),
             points.size(), period);
  return !cells_.shared() && count(points, true);
}

/// Leaves in `start_` where each bucket ends. False where cells that were made larger are crowded.
bool CellOrder::count(std::span<const Point> points, bool enlarged) {
  bucket_.resize(points.size());
  start_.assign(cells_.buckets() + 1, 0);
  double meetings = 0.0;
  for (std::size_t row = 0; row < points.size(); ++row) {
    bucket_[row] = static_cast<std::uint32_t>(cells_.bucket(cells_.cell(points[row])));
    meetings += 2.0 * start_[bucket_[row]]++ + 1.0;
  }
  if (enlarged && meetings > kMostMeetings * static_cast<double>(points.size())) return false;
  std::uint32_t sum = 0;
  for (std::uint32_t& start : start_) start = sum += start;
  return true;
}

}  // namespace throng::broadphase
