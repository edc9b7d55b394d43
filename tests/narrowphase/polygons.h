// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "random_shapes.h"

/// Simple polygons that are hard on algorithms.
namespace throng::narrowphase {

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

}  // namespace throng::narrowphase
