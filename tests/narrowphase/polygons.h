// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "narrowphase/holes.h"
#include "narrowphase/polygon.h"
#include "random_shapes.h"

/// Simple polygons that are hard on algorithms.
namespace throng::narrowphase {

inline std::vector<Vec> square(double half, const Vec& at = {0, 0}) {
  return {at + Vec(-half, -half), at + Vec(half, -half), at + Vec(half, half), at + Vec(-half, half)};
}

/// Every other vertex at `inner` of the radius 1.
inline std::vector<Vec> star(int count, double inner) {
  std::vector<Vec> points;
  for (int i = 0; i < count; ++i) {
    const Pose p = pose({0, 0}, 2 * std::numbers::pi * i / count);
    points.push_back((i % 2 ? inner : 1.0) * Vec(p.cos, p.sin));
  }
  return points;
}

/// A band that winds `turns` times round the origin.
inline std::vector<Vec> spiral(int count, int turns) {
  std::vector<Vec> points;
  for (int i = 0; i < count; ++i) {
    const bool back = i >= count / 2;
    const double t = static_cast<double>(back ? count - 1 - i : i) / (count / 2);
    const Pose p = pose({0, 0}, 2 * std::numbers::pi * turns * t);
    points.push_back((1.0 + turns * t + (back ? 0.0 : 0.5)) * Vec(p.cos, p.sin));
  }
  return points;
}

/// Long thin teeth side by side.
inline std::vector<Vec> comb(int count) {
  std::vector<Vec> points{{0, -1}, {static_cast<double>(count), -1}};
  for (int i = count - 2; i > 0; --i) points.emplace_back(i, i % 2 ? 0.0 : 1e4);
  return points;
}

/// A star-shaped polygon with random radii: simple, mostly far from convex.
inline std::vector<Vec> random_simple(Random& random, int count) {
  std::vector<Vec> points;
  for (int i = 0; i < count; ++i) {
    const Pose p = pose({0, 0}, 2 * std::numbers::pi * (i + uniform(random, 0, 0.9)) / count);
    points.push_back(uniform(random, 0.1, 1.0) * Vec(p.cos, p.sin));
  }
  return points;
}

inline std::vector<Vec> random_on_grid(Random& random, std::size_t count, const Vec& low, int size) {
  std::vector<Vec> points;
  for (; points.size() < count;) {
    const double x = static_cast<double>(random() % static_cast<unsigned>(size + 1));
    const double y = static_cast<double>(random() % static_cast<unsigned>(size + 1));
    points.push_back(low + Vec(x, y));
  }
  return points;
}

/// Within 12 of the origin, on the grid, simple.
inline std::vector<Vec> random_simple_on_grid(Random& random) {
  for (;;) {
    std::vector<Vec> points = random_simple(random, 4 + static_cast<int>(random() % 9));
    for (Vec& v : points) v = {std::round(12.0 * v.x()), std::round(12.0 * v.y())};
    points = clean(points).vertices;
    if (!points.empty()) return points;
  }
}

/// Rings of a polygon, every second one a square, with up to `tries` small holes, all of it on a grid, where
/// much stands in line.
inline std::vector<std::vector<Vec>> random_with_holes(Random& random, int tries) {
  const std::vector<Vec> square{{-12, -12}, {12, -12}, {12, 12}, {-12, 12}};
  std::vector<std::vector<Vec>> rings{random() % 2 ? square : random_simple_on_grid(random)};
  for (int i = 0; i < tries; ++i) {
    const Vec corner = random_on_grid(random, 1, {-12, -12}, 24)[0];
    rings.push_back(random_on_grid(random, 3 + random() % 3, corner, 1 + static_cast<int>(random() % 5)));
    if (clean(rings).rings.empty()) rings.pop_back();
  }
  return clean(rings).rings;
}

/// A board of n by n square holes.
inline std::vector<std::vector<Vec>> grating(int n) {
  const double side = 2.0 * n + 1.0;
  std::vector<std::vector<Vec>> rings{{{0, 0}, {side, 0}, {side, side}, {0, side}}};
  for (int i = 0; i < n * n; ++i) {
    const double x = 2.0 * (i / n) + 1.0, y = 2.0 * (i % n) + 1.0;
    rings.push_back({{x, y}, {x, y + 1.0}, {x + 1.0, y + 1.0}, {x + 1.0, y}});
  }
  return rings;
}

}  // namespace throng::narrowphase
