// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "broadphase/box_index.h"
#include "broadphase/neighbours.h"
#include "broadphase/pairs.h"
#include "broadphase/point.h"

/// The definitions: what each structure of this floor answers, the slow and obvious way. O(n²) or O(n) a
/// question.
namespace throng::broadphase::brute_force {

/// All rows a < b with `near(a, b)`, ascending.
template <class Near>
std::vector<Pair> pairs(std::size_t rows, Near&& near) {
  std::vector<Pair> result;
  for (std::uint32_t a = 0; a < rows; ++a)
    for (std::uint32_t b = a + 1; b < rows; ++b)
      if (near(a, b)) result.push_back({a, b});
  return result;
}

/// All rows a < b at most `reach` apart.
inline std::vector<Pair> pairs(std::span<const Point> points, double reach, const Period* period = nullptr) {
  return pairs(points.size(), [&](std::uint32_t a, std::uint32_t b) {
    return squared_distance(points[a], points[b], period) <= reach * reach;
  });
}

/// All rows a < b with |p_a - p_b| <= reach[a] + reach[b].
inline std::vector<Pair> pairs(std::span<const Point> points, std::span<const double> reach,
                               const Period* period = nullptr) {
  return pairs(points.size(), [&](std::uint32_t a, std::uint32_t b) {
    const double most = reach[a] + reach[b];
    return squared_distance(points[a], points[b], period) <= most * most;
  });
}

/// From `p` to the nearest image of `q`.
inline Point displacement(const Point& p, const Point& q, const Period* period) {
  const Point d = q - p;
  return period ? Point(fold(d.x(), period->size.x()), fold(d.y(), period->size.y())) : d;
}

/// Of `rows` things, those within reach, in view and wanted, ascending by (distance, row). `offset(row)` is
/// where a thing is seen from `place`, `distance(row, offset)` how far it is, `within(row, offset)` whether
/// that is near enough.
template <class Offset, class Distance, class Within>
std::vector<Neighbour> near(std::size_t rows, const Place& place, const Near& near,
                            ProximityTree::GroupBits groups, Offset&& offset, Distance&& distance,
                            Within&& within) {
  std::vector<Neighbour> result;
  for (std::uint32_t row = 0; row < rows; ++row) {
    const Point d = offset(row);
    const bool wanted = row != place.except && (groups.empty() || (groups[row] & near.groups) != 0);
    if (wanted && within(row, d) && near.view.sees(place.heading, d))
      result.push_back({row, distance(row, d)});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
  if (result.size() > near.most) result.resize(near.most);
  return result;
}

/// All points near a place, ascending by (distance, row).
inline std::vector<Neighbour> near(std::span<const Point> points, const Place& place, const Near& what,
                                   const Period* period = nullptr, ProximityTree::GroupBits groups = {}) {
  return near(
      points.size(), place, what, groups,
      [&](std::uint32_t row) { return displacement(place.at, points[row], period); },
      [](std::uint32_t, const Point& d) { return std::sqrt(d.x() * d.x() + d.y() * d.y()); },
      [&](std::uint32_t, const Point& d) {
        return d.x() * d.x() + d.y() * d.y() <= what.radius * what.radius;
      });
}

/// The same of discs, to the rim.
inline std::vector<Neighbour> near(std::span<const Point> centres, std::span<const double> radius,
                                   const Place& place, const Near& what, const Period* period = nullptr,
                                   ProximityTree::GroupBits groups = {}) {
  const auto rim = [&](std::uint32_t row, const Point& d) {
    return std::sqrt(d.x() * d.x() + d.y() * d.y()) - radius[row];
  };
  return near(
      centres.size(), place, what, groups,
      [&](std::uint32_t row) { return displacement(place.at, centres[row], period); }, rim,
      [&](std::uint32_t row, const Point& d) { return rim(row, d) <= what.radius; });
}

/// The same of boxes, to their nearest points.
inline std::vector<Neighbour> near(std::span<const Box> boxes, const Place& place, const Near& what,
                                   ProximityTree::GroupBits groups = {}) {
  return near(
      boxes.size(), place, what, groups,
      [&](std::uint32_t row) -> Point {
        const Point& p = place.at;
        const Box& box = boxes[row];
        return (box.min() - p).cwiseMax(0.0) + (box.max() - p).cwiseMin(0.0);
      },
      [](std::uint32_t, const Point& d) { return std::sqrt(d.x() * d.x() + d.y() * d.y()); },
      [&](std::uint32_t, const Point& d) {
        return d.x() * d.x() + d.y() * d.y() <= what.radius * what.radius;
      });
}

/// All rows of the extents that touch `box`, ascending.
inline std::vector<std::uint32_t> near(std::span<const Extent> extents, const Box& box) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t row = 0; row < extents.size(); ++row)
    if (touches(extents[row], box)) result.push_back(row);
  return result;
}

}  // namespace throng::broadphase::brute_force
