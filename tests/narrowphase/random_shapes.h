// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "narrowphase/convex.h"

/// Shapes for tests against the definition: generic ones, and those that break geometry code.
namespace throng::narrowphase {

using Random = std::mt19937_64;

inline constexpr double kUnitRoundoff = 0x1p-53;

inline double uniform(Random& random, double from, double to) {
  return from + (to - from) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

/// The strict convex hull, counter-clockwise (Andrew 1979).
inline std::vector<Vec> hull(std::vector<Vec> points) {
  const auto less = [](const Vec& p, const Vec& q) { return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y(); };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec> result;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = result.size();
    for (const Vec& p : points) {
      while (result.size() >= start + 2) {
        const Vec u = result[result.size() - 1] - result[result.size() - 2],
                  v = p - result[result.size() - 1];
        if (static_cast<long double>(u.x()) * v.y() - static_cast<long double>(u.y()) * v.x() > 0) break;
        result.pop_back();
      }
      result.push_back(p);
    }
    result.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return result;
}

struct Placement {
  Convex shape;
  Pose pose;
};

struct ShapePair {
  std::string family;
  Placement a, b;
  double scale;  ///< of all the coordinates, relative to each other
  double world;  ///< of the coordinates in the world
};

/// In braces, which are evaluated in order with every compiler: the same shapes everywhere.
inline Vec random_vec(Random& random, double x, double y) {
  return Vec{uniform(random, -x, x), uniform(random, -y, y)};
}

inline Convex random_shape(Random& random, double aspect) {
  const std::size_t kind = random() % 6;
  const double radius = random() % 3 == 0 ? uniform(random, 0.0, 0.5) : 0.0;
  if (kind == 0) {
    const Vec centre = random_vec(random, 0.2, 0.0);
    return disc(uniform(random, 0.1, 1.0), centre);
  }
  if (kind == 1) {
    const Vec p = random_vec(random, 2.0, aspect);
    return segment(p, {uniform(random, 2.1, 2.5), 0.0}, radius);
  }
  std::vector<Vec> points;
  for (std::size_t n = 3 + random() % 12; points.size() < n;)
    points.push_back(random_vec(random, 1.0, aspect));
  return convex(hull(points), radius);
}

inline Vec gridded_vec(Random& random, unsigned cells) {
  const double half = 0.25 * (cells - 1);
  return Vec{0.5 * static_cast<double>(random() % cells) - half,
             0.5 * static_cast<double>(random() % cells) - half};
}

inline Convex gridded_shape(Random& random) {
  std::vector<Vec> points;
  for (std::size_t n = 1 + random() % 10; points.size() < n;) points.push_back(gridded_vec(random, 5));
  return convex(hull(points), random() % 4 == 0 ? 0.25 : 0.0);
}

inline Pose gridded_pose(Random& random) {
  constexpr double kCos[] = {1, 0, -1, 0}, kSin[] = {0, 1, 0, -1};
  const std::size_t turn = random() % 4;
  return {gridded_vec(random, 9), kCos[turn], kSin[turn]};
}

inline Pose random_pose(Random& random, double range) {
  const Vec position{uniform(random, -range, range), uniform(random, -range, range)};
  return pose(position, uniform(random, -4, 4));
}

inline Convex scaled(const Convex& shape, double factor) {
  std::vector<Vec> vertices = shape.vertices;
  for (Vec& v : vertices) v *= factor;
  return convex(std::move(vertices), shape.radius * factor);
}

/// The neighbour that shares an edge with `shape`: its mirror image in the line of that edge, up to rounding.
inline Placement mirrored(const Convex& shape, const Pose& pose, std::size_t edge) {
  const Vec n = shape.normals[edge];
  std::vector<Vec> vertices;
  for (const Vec& v : shape.vertices) vertices.push_back(v - 2 * n.dot(v - shape.vertices[edge]) * n);
  return {convex(hull(vertices), 0.0), pose};
}

inline ShapePair random_pair(Random& random) {
  const auto family = random() % 7;
  const double range = 1.6;
  ShapePair p{"generic",
              {random_shape(random, 1.0), random_pose(random, range)},
              {random_shape(random, 1.0), random_pose(random, range)},
              8.0,
              8.0};
  if (family == 1)
    p = {"gridded",
         {gridded_shape(random), gridded_pose(random)},
         {gridded_shape(random), gridded_pose(random)},
         8.0,
         8.0};
  if (family == 2) {
    p.family = "sliver";
    p.a.shape = random_shape(random, std::pow(10.0, uniform(random, -12, 0)));
    if (random() % 2) p.b.shape = random_shape(random, std::pow(10.0, uniform(random, -12, 0)));
    if (random() % 2) p.b.pose.cos = p.a.pose.cos, p.b.pose.sin = p.a.pose.sin;
    if (random() % 4 == 0)
      p.b.pose.position = p.a.pose.position + p.a.pose.rotate({uniform(random, -4, 4), 0});
  }
  if (family == 3 && p.a.shape.vertices.size() > 1) {
    p.family = "shared edge";
    p.a.shape.radius = 0.0;
    p.b = mirrored(p.a.shape, p.a.pose, random() % p.a.shape.normals.size());
  }
  if (family == 4) {
    p.family = "containment";
    p.b.shape = scaled(p.b.shape, std::pow(10.0, uniform(random, -6, -1)));
    p.b.pose.position = p.a.pose.position + Vec{uniform(random, -0.2, 0.2), uniform(random, -0.2, 0.2)};
  }
  if (family == 5) {
    p.family = "far away";
    const Vec offset{uniform(random, -1e6, 1e6), uniform(random, -1e6, 1e6)};
    p.a.pose.position += offset, p.b.pose.position += offset, p.world = 1e6;
  }
  if (family == 6) {
    p.family = "scaled";
    const double factor = std::pow(10.0, uniform(random, -6, 6));
    p.a.shape = scaled(p.a.shape, factor), p.b.shape = scaled(p.b.shape, factor);
    p.a.pose.position *= factor, p.b.pose.position *= factor, p.scale *= factor, p.world *= factor;
  }
  return p;
}

}  // namespace throng::narrowphase
