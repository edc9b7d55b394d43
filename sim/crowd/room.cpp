// SPDX-License-Identifier: MIT
// Squares that no such place can be in are left out, others are cut in four: Garcia-Castellanos and Lombardo,
// "Poles of inaccessibility" (Scottish Geographical Journal 2007).
#include "sim/crowd/room.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace throng {

namespace {

constexpr double kFinest = 0.01;        // of a radius
constexpr double kMostSquares = 65536;  // of the first
constexpr int kLooks = 32;              // at a region's span, in a quarter of the directions

struct Square {
  Vec middle;
  double half;  // m
};

std::vector<Square> squares_over(const Eigen::AlignedBox2d& box) {
  const Vec size = box.sizes();
  const double side = std::max({size.minCoeff(), size.maxCoeff() / kMostSquares, 1e-300});
  std::vector<Square> squares;
  for (double y = 0.0; y < size.y(); y += side)
    for (double x = 0.0; x < size.x(); x += side)
      squares.push_back({Vec(box.min() + Vec(x + 0.5 * side, y + 0.5 * side)), 0.5 * side});
  return squares;
}

/// m, below 0 outside.
double depth(const Region& region, const Vec& p) {
  const double border = (nearest_on_border(region, p) - p).norm();
  return contains(region, p) ? border : -border;
}

}  // namespace

bool has_room(const Region& area, const Region& walkable, const Barriers& barriers, double radius) {
  const Eigen::AlignedBox2d floor = bounds(walkable);
  std::vector<Square> squares = squares_over(bounds(area).intersection(floor));
  while (!squares.empty()) {
    const auto [middle, half] = squares.back();
    squares.pop_back();
    const double reach = std::sqrt(2.0) * half, inside = depth(area, middle);
    if (inside + reach < 0.0) continue;
    const double off = barriers.distance(middle, 2.0 * radius + reach);
    const double clear = contains(walkable, middle) ? off : -off;
    const double room = std::max(std::min(inside, clear) - radius, std::min(inside, clear - 2.0 * radius));
    if (room >= 0.0) return true;
    if (room + reach < 0.0 || half < kFinest * radius) continue;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) squares.push_back({Vec(middle + half * Vec(x, y)), 0.5 * half});
  }
  return false;
}

double span(const Region& region) {
  double most = 0.0;
  for (int look = -kLooks; look < kLooks; ++look) {
    const Vec along = Vec(look, kLooks - std::abs(look)).normalized();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::vector<Vec>& ring : region.rings)
      for (const Vec& p : ring) low = std::min(low, p.dot(along)), high = std::max(high, p.dot(along));
    most = std::max(most, high - low);
  }
  return most;
}

double largest_with_room(const Region& area, const Region& walkable, const Barriers& barriers,
                         double widest) {
  if (has_room(area, walkable, barriers, widest)) return widest;
  double has = 0.0, lacks = widest;
  while (lacks - has > 1e-3 * widest) {
    const double middle = 0.5 * (has + lacks);
    (has_room(area, walkable, barriers, middle) ? has : lacks) = middle;
  }
  return has;
}

}  // namespace throng
