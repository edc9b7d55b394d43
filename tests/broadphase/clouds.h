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

/// The kinds of clouds that the benchmarks know too.
enum class Spread { uniform, clustered, line, mixed };
constexpr Spread kSpreads[] = {Spread::uniform, Spread::clustered, Spread::line, Spread::mixed};

/// `n` points within a square of `side`: evenly, in blobs a thousandth as wide, on a diagonal, or all of it
/// and some that coincide.
inline Points spread(Random& random, Spread how, std::size_t n, double side) {
  Points points, blobs;
  for (int i = 0; i < 3; ++i) blobs.push_back(0.999 * random.in_square(side));
  for (std::size_t row = 0; row < n; ++row) {
    const Spread kind = how == Spread::mixed ? kSpreads[row % 3] : how;
    Point p = random.in_square(side);
    if (kind == Spread::clustered) p = blobs[random.below(3)] + 0.001 * p;
    if (kind == Spread::line) p.y() = p.x();
    if (how == Spread::mixed && row % 7 == 6) p = points[random.below(row)];
    points.push_back(p);
  }
  return points;
}

inline Points moved(Points points, const Point& by) {
  for (Point& p : points) p += by;
  return points;
}

}  // namespace throng::broadphase
