// SPDX-License-Identifier: MIT
#include "narrowphase/half_plane.h"

#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// A half-plane in a shape's own frame.
struct Local {
  Vec normal;
  double offset;  // of the shape's origin

  Local(const Pose& pose, const HalfPlane& free)
      : normal(pose.unrotate(free.normal)), offset(dot(free.normal, pose.position - free.point)) {}
  double height(const Vec& v) const { return dot(normal, v) + offset; }
};

std::size_t lowest_vertex(const Convex& shape, const Local& local) {
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < shape.vertices.size(); ++i)
    if (local.height(shape.vertices[i]) < local.height(shape.vertices[lowest])) lowest = i;
  return lowest;
}

void add(Manifold& m, const Convex& shape, const Pose& pose, const Local& local, std::size_t vertex,
         double reach) {
  const double height = local.height(shape.vertices[vertex]);
  const double separation = height - shape.radius;
  if (separation > reach) return;
  const Vec middle = shape.vertices[vertex] - (shape.radius + 0.5 * separation) * local.normal;
  m.points[static_cast<std::size_t>(m.count++)] = {pose * middle, separation,
                                                   static_cast<std::uint32_t>(vertex)};
}

}  // namespace

double clearance(const Convex& shape, const Pose& pose, const HalfPlane& free) {
  const Local local(pose, free);
  return local.height(shape.vertices[lowest_vertex(shape, local)]) - shape.radius;
}

Manifold manifold(const Convex& shape, const Pose& pose, const HalfPlane& free, double reach) {
  const Local local(pose, free);
  const std::size_t count = shape.vertices.size(), lowest = lowest_vertex(shape, local);
  Manifold m;
  add(m, shape, pose, local, lowest, reach);
  if (m.count == 0) return m;
  m.normal = -free.normal;
  if (count == 1) return m;
  // The other end of the edge that faces the half-plane, not the lower neighbour: of a sliver that is tilted
  // by more than it is thick this is the same end's other corner, and nothing would hold the far end.
  const std::size_t left = previous(lowest, count), right = next(lowest, count);
  const bool is_left = dot(shape.normals[left], local.normal) < dot(shape.normals[lowest], local.normal);
  add(m, shape, pose, local, is_left ? left : right, reach);
  return m;
}

}  // namespace throng::narrowphase
