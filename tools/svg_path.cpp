// SPDX-License-Identifier: MIT
#include "tools/svg_path.h"

#include <cstdio>

namespace throng::tools {

namespace {

using narrowphase::Convex;
using narrowphase::Pose;

std::string point(const Vec& at) {
  char text[64];
  std::snprintf(text, sizeof text, "%.9g %.9g", at.x(), at.y());
  return text;
}

std::string arc_to(double radius, const Vec& end) {
  char text[64];
  std::snprintf(text, sizeof text, "A%.9g %.9g 0 0 1 ", radius, radius);
  return text + point(end);
}

std::string disc_path(const Vec& centre, double radius) {
  const Vec reach(radius, 0.0);
  return "M" + point(centre - reach) + arc_to(radius, centre + reach) + arc_to(radius, centre - reach) + "Z";
}

/// Straight along the edges, an arc about each vertex.
std::string part_path(const Convex& part, const Pose& pose, const Vec& origin) {
  const std::size_t n = part.vertices.size();
  if (n == 1) return disc_path(pose * part.vertices[0] - origin, part.radius);
  std::string path;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec at = pose * part.vertices[i] - origin;
    const Vec begin = at + part.radius * pose.rotate(part.normals[(i + n - 1) % n]);
    path += (i == 0 ? "M" : "L") + point(begin);
    if (part.radius > 0.0) path += arc_to(part.radius, at + part.radius * pose.rotate(part.normals[i]));
  }
  return path + "Z";
}

}  // namespace

std::string svg_path(const MotionShape& shape, const Pose& pose, const Vec& origin) {
  std::string path;
  for (const std::vector<Vec>& ring : shape.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      path += (i == 0 ? "M" : "L") + point(pose * ring[i] - origin);
    path += "Z";
  }
  if (!shape.rings.empty()) return path;
  for (const Convex& part : shape.parts) path += part_path(part, pose, origin);
  return path;
}

}  // namespace throng::tools
