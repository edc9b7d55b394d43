// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

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

}  // namespace throng::broadphase::brute_force
