// SPDX-License-Identifier: MIT
#include "sim/crowd/size_classes.h"

#include <algorithm>

#include "sim/crowd/floor_plan.h"

namespace throng {

namespace {

constexpr double kAlike = 1.5;    // ways that keep as far from walls as the largest suit the least
constexpr double kCoarser = 1.1;  // from try to try

/// Expects ascending radii. Radii up to `merged` times the least are one class whatever is open to them.
std::vector<SizeClass> classes(const std::vector<double>& radii, const std::vector<double>& passages,
                               double merged) {
  const auto closed = [&](double radius) { return std::ranges::upper_bound(passages, closed_to(radius)); };
  std::vector<SizeClass> result;
  for (const double radius : radii) {
    const double least = result.empty() ? 0.0 : result.back().least;
    const bool is_alike = radius <= kAlike * least && closed(radius) == closed(least);
    if (is_alike || radius <= merged * least)
      result.back().largest = radius;
    else
      result.push_back({radius, radius});
  }
  return result;
}

}  // namespace

std::vector<SizeClass> size_classes(std::vector<double> radii, const std::vector<double>& passages) {
  std::ranges::sort(radii);
  std::vector<SizeClass> result = classes(radii, passages, 1.0);
  for (double merged = 1.01; result.size() > kMostSizes; merged = 1.0 + kCoarser * (merged - 1.0))
    result = classes(radii, passages, merged);
  return result;
}

}  // namespace throng
