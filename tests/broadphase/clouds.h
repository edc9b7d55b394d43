// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "broadphase/point.h"

/// Clouds of points that are hard on a grid, drawn from a seed.
namespace throng::broadphase {

using Points = std::vector<Point>;

/// Raw bits of the Mersenne twister scaled to [0, 1): the same on every library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits_() % n); }
  Point in_square(double side) {
    const double x = unit(), y = unit();
    return {side * x, side * y};
  }

  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
  }

 private:
  std::mt19937_64 bits_;
};

/// `n` points of a square of `side`, of which every 8th stands on another, every 8th on a whole coordinate (a
/// cell's border where cells are 1), and every 8th at an exact distance of 1 from another along an axis.
inline Points cloud(Random& random, std::size_t n, double side) {
  Points points;
  for (std::size_t row = 0; row < n; ++row) {
    Point p = random.in_square(side);
    if (row % 8 == 1) p = points[random.below(row)];
    if (row % 8 == 3) p = p.array().floor();
    if (row % 8 == 5) {
      p = points[random.below(row)];
      p.x() += p.x() + 1.0 <= side ? 1.0 : p.x() >= 1.0 ? -1.0 : 0.0;
    }
    points.push_back(p);
  }
  return points;
}

inline Points moved(Points points, const Point& by) {
  for (Point& p : points) p += by;
  return points;
}

}  // namespace throng::broadphase
