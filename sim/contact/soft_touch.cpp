// SPDX-License-Identifier: MIT
#include "sim/contact/soft_touch.h"

#include <algorithm>

namespace throng {

using narrowphase::Convex;
using narrowphase::Pose;

namespace {

/// The place of the segment from p to q that is nearest to `point`.
Vec nearest_on(const Vec& p, const Vec& q, const Vec& point) {
  const Vec way = q - p;
  return p + std::clamp(way.dot(point - p) / way.squaredNorm(), 0.0, 1.0) * way;
}

/// The edge whose line `point` is farthest outside of: the nearest surface is on it, or at one of its ends.
std::size_t outermost_edge(const Convex& part, const Vec& point, double& distance) {
  std::size_t edge = 0;
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    const double outside = part.normals[i].dot(point - part.vertices[i]);
    if (i == 0 || outside > distance) edge = i, distance = outside;
  }
  return edge;
}

}  // namespace

NearestSurface nearest_surface(const Vec& point, const narrowphase::HalfPlane& free) {
  return {free.normal.dot(point - free.point), -free.normal};
}

NearestSurface nearest_surface(const Vec& point, const Convex& part, const Pose& pose) {
  const Vec local = pose.unrotate(point - pose.position);
  Vec nearest = part.vertices[0], inward(1.0, 0.0);
  if (part.vertices.size() > 1) {
    double outside = 0.0;
    const std::size_t edge = outermost_edge(part, local, outside);
    inward = -part.normals[edge];
    if (part.vertices.size() > 2 && outside <= 0.0) return {outside - part.radius, pose.rotate(inward)};
    nearest = nearest_on(part.vertices[edge], part.vertices[(edge + 1) % part.vertices.size()], local);
  }
  const Vec way = nearest - local;
  const double distance = way.norm();
  if (distance > 0.0) inward = way / distance;
  return {distance - part.radius, pose.rotate(inward)};
}

}  // namespace throng
