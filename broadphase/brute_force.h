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

/// All points near `p`, ascending by (distance, row).
inline std::vector<Neighbour> near(std::span<const Point> points, const Point& p, const Near& near,
                                   const Period* period = nullptr, std::optional<std::uint32_t> except = {}) {
  std::vector<Neighbour> result;
  for (std::uint32_t row = 0; row < points.size(); ++row) {
    const double squared = squared_distance(points[row], p, period);
    if (row != except && squared <= near.radius * near.radius) result.push_back({row, std::sqrt(squared)});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
  if (result.size() > near.most) result.resize(near.most);
  return result;
}

/// All rows of the extents that touch `box`, ascending.
inline std::vector<std::uint32_t> near(std::span<const Extent> extents, const Box& box) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t row = 0; row < extents.size(); ++row)
    if (touches(extents[row], box)) result.push_back(row);
  return result;
}

}  // namespace throng::broadphase::brute_force
