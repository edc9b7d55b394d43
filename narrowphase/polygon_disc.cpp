// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "narrowphase/core_separation.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

struct Extremum {
  double value;
  std::size_t index;
};

/// The edge whose line lies farthest before the point.
Extremum widest_edge(const Convex& polygon, const Vec& point) {
  Extremum best{-std::numeric_limits<double>::infinity(), 0};
  for (std::size_t i = 0; i < polygon.normals.size(); ++i)
    if (const double s = dot(polygon.normals[i], point - polygon.vertices[i]); s > best.value) best = {s, i};
  return best;
}

Extremum nearest_vertex(const Convex& polygon, const Vec& point) {
  Extremum best{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Vec d = point - polygon.vertices[i];
    if (const double squared = dot(d, d); squared < best.value) best = {squared, i};
  }
  return best;
}

bool projects_onto(const Convex& polygon, std::size_t edge, const Vec& point) {
  const Vec& tail = polygon.vertices[edge];
  const Vec& head = polygon.vertices[next(edge, polygon.vertices.size())];
  return dot(point - tail, head - tail) >= 0.0 && dot(point - head, tail - head) >= 0.0;
}

/// How far the vertices reach from `point`: what rounding is measured by.
double extent(const Convex& polygon, const Vec& point) {
  double most = 0.0;
  for (const Vec& v : polygon.vertices)
    most = std::max({most, std::abs(v.x() - point.x()), std::abs(v.y() - point.y())});
  return most;
}

/// Whether the normal of `found` proves that all of the polygon stays behind the point. Where a needle points
/// at it, no edge's line does.
bool proves_outside(const Convex& polygon, const Vec& point, const CoreSeparation& found) {
  double gap = std::numeric_limits<double>::infinity();
  for (const Vec& v : polygon.vertices) gap = std::min(gap, dot(found.normal, point - v));
  return 2.0 * gap > found.distance;
}

}  // namespace

CoreSeparation disc_disc(const Vec& centre, const Vec& offset) {
  const Direction d = direction(offset, {1.0, 0.0});
  return {d.length, d.unit, centre};
}

CoreSeparation nearest(const Convex& polygon, const Vec& point) {
  const Extremum vertex = nearest_vertex(polygon, point);
  const std::size_t widest = widest_edge(polygon, point).index;
  const Vec& corner = polygon.vertices[vertex.index];
  const Direction d = direction(point - corner, polygon.normals[widest]);
  CoreSeparation best{d.length, d.unit, corner};
  for (std::size_t i = 0; i < polygon.normals.size(); ++i) {
    const Vec& normal = polygon.normals[i];
    const double s = dot(normal, point - polygon.vertices[i]);
    if ((s < 0.0 && i != widest) || s > best.distance || !projects_onto(polygon, i, point)) continue;
    best = {std::max(0.0, s), normal, point - s * normal};
  }
  return best;
}

CoreSeparation polygon_disc(const Convex& polygon, const Vec& point, double enough) {
  const auto [s, edge] = widest_edge(polygon, point);
  const Vec& normal = polygon.normals[edge];
  const CoreSeparation face{s, normal, point - s * normal};
  if (s > enough || s < -kCoreRounding * extent(polygon, point)) return face;
  const CoreSeparation outside = nearest(polygon, point);
  return proves_outside(polygon, point, outside) ? outside : face;
}

}  // namespace throng::narrowphase
