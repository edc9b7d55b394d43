// SPDX-License-Identifier: MIT
#include "narrowphase/convex.h"

#include <utility>

#include "narrowphase/relative.h"
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
    const Vec along = direction(shape.vertices[next(i, count)] - shape.vertices[i], {0.0, 1.0}).unit;
    shape.normals.emplace_back(along.y(), -along.x());
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
