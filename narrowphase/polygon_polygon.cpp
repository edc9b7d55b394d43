// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "narrowphase/core_separation.h"
#include "narrowphase/face.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// Two polygons in the frame of the first.
struct Relative {
  const Convex& a;
  const Convex& b;
  const Pose b_in_a, a_in_b;
};

CoreSeparation flipped(const CoreSeparation& s, const Pose& frame) {
  return {s.distance, -frame.rotate(s.normal), frame * (s.point + s.distance * s.normal)};
}

CoreSeparation vertex_of_b(const Relative& p, std::size_t j) {
  return nearest(p.a, p.b_in_a * p.b.vertices[j]);
}

CoreSeparation vertex_of_a(const Relative& p, std::size_t i) {
  return flipped(nearest(p.b, p.a_in_b * p.a.vertices[i]), p.b_in_a);
}

/// How far the two supports along `normal` are apart, in a's frame.
struct Supports {
  double a, b;
  double gap() const { return b - a; }
};

Supports supports(const Relative& p, const Vec& normal) {
  Supports s{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const Vec& v : p.a.vertices) s.a = std::max(s.a, dot(normal, v));
  const Vec in_b = p.b_in_a.unrotate(normal);
  for (const Vec& v : p.b.vertices) s.b = std::min(s.b, dot(in_b, v));
  s.b += dot(normal, p.b_in_a.position);
  return s;
}

double extent(const Relative& p) {
  double a = 0.0, b = 0.0;
  for (const Vec& v : p.a.vertices) a = std::max({a, std::abs(v.x()), std::abs(v.y())});
  for (const Vec& v : p.b.vertices) b = std::max({b, std::abs(v.x()), std::abs(v.y())});
  return a + b + std::abs(p.b_in_a.position.x()) + std::abs(p.b_in_a.position.y());
}

/// The nearest points of two polygons that are apart, from any vertex's: an upper bound. Its normal's
/// supports bound the distance from below, and only vertices within the difference of the supports can do
/// better.
CoreSeparation closest(const Relative& p, CoreSeparation best) {
  const Vec normal = best.normal;
  const Supports limit = supports(p, normal);
  const double slack = std::max(0.0, best.distance - limit.gap()) + kCoreRounding * extent(p);
  const Vec in_b = p.b_in_a.unrotate(normal);
  const double offset = dot(normal, p.b_in_a.position);
  const auto keep = [&best](const CoreSeparation& s) {
    if (s.distance < best.distance) best = s;
  };
  for (std::size_t j = 0; j < p.b.vertices.size(); ++j)
    if (dot(in_b, p.b.vertices[j]) + offset <= limit.b + slack) keep(vertex_of_b(p, j));
  for (std::size_t i = 0; i < p.a.vertices.size(); ++i)
    if (dot(normal, p.a.vertices[i]) >= limit.a - slack) keep(vertex_of_a(p, i));
  return best;
}

/// The deepest vertex, put on the face; beyond the face's end only where an edge lies parallel to it, which
/// then covers that end.
Vec on_face(const Convex& polygon, const Face& face, const Vec& vertex) {
  const Vec& tail = polygon.vertices[face.edge];
  const Direction edge =
      direction(polygon.vertices[next(face.edge, polygon.vertices.size())] - tail, {1.0, 0.0});
  return tail + std::clamp(dot(vertex - tail, edge.unit), 0.0, edge.length) * edge.unit;
}

CoreSeparation face_of_a(const Relative& p, const Face& face) {
  return {face.separation, p.a.normals[face.edge], on_face(p.a, face, p.b_in_a * p.b.vertices[face.vertex])};
}

CoreSeparation face_of_b(const Relative& p, const Face& face) {
  const Vec point = on_face(p.b, face, p.a_in_b * p.a.vertices[face.vertex]);
  return flipped({face.separation, p.b.normals[face.edge], point}, p.b_in_a);
}

}  // namespace

CoreSeparation polygon_polygon(const Convex& a, const Convex& b, const Pose& b_in_a, const Faces& faces) {
  const Relative p{a, b, b_in_a, inverse(b_in_a)};
  const bool first = faces.a_is_wider();
  const CoreSeparation face = first ? face_of_a(p, faces.of_a) : face_of_b(p, faces.of_b);
  if (face.distance < -kCoreRounding * extent(p)) return face;
  const CoreSeparation apart =
      closest(p, first ? vertex_of_b(p, faces.of_a.vertex) : vertex_of_a(p, faces.of_b.vertex));
  const bool proven = 2.0 * supports(p, apart.normal).gap() > apart.distance;
  return proven ? apart : face;
}

}  // namespace throng::narrowphase
