// SPDX-License-Identifier: MIT
#include "narrowphase/convex.h"

#include <cmath>
#include <utility>

#include "narrowphase/trigonometry.h"

namespace throng::narrowphase {

Pose pose(const Vec& position, double angle) {
  const SinCos u = sin_cos(angle);
  return {position, u.cos, u.sin};
}

Convex convex(std::vector<Vec> vertices, double radius) {
  Convex shape{std::move(vertices), {}, radius};
  const std::size_t count = shape.vertices.size();
  if (count < 2) return shape;
  shape.normals.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec edge = shape.vertices[i + 1 == count ? 0 : i + 1] - shape.vertices[i];
    const double length = std::sqrt(edge.x() * edge.x() + edge.y() * edge.y());
    shape.normals.emplace_back(edge.y() / length, -edge.x() / length);
  }
  return shape;
}

Convex disc(double radius, const Vec& centre) {
  return convex({centre}, radius);
}

Convex segment(const Vec& p, const Vec& q, double radius) {
  return convex({p, q}, radius);
}

}  // namespace throng::narrowphase
