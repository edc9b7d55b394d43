// SPDX-License-Identifier: MIT
#include "narrowphase/disc_fall.h"

#include <algorithm>

#include "narrowphase/disc_flight.h"
#include "narrowphase/polynomial.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// When a point comes within `reach` of the origin.
double time_to_point(const Fall& point, double reach, double until) {
  const Vec &p = point.position, &v = point.velocity, &g = point.pull;
  const double touching = std::max(0.0, dot(p, p) - reach * reach);  // nobody is nearer, but by rounding
  const Polynomial<4> excess = {touching, 2.0 * dot(p, v), dot(v, v) + dot(p, g), dot(v, g),
                                0.25 * dot(g, g)};
  double from = 0.0;
  const auto turns = sign_changes(derivative(excess), 0.0, until);
  for (std::size_t i = 0; i <= turns.count; ++i) {
    const double to = i < turns.count ? turns.at[i] : until;
    const double before = value(excess, from), after = value(excess, to);
    if (before > 0.0 && after <= 0.0) return sign_change(excess, from, to);
    if (from == 0.0 && before <= 0.0 && after < before) return 0.0;
    from = to;
  }
  return kNever;
}

/// When the centre crosses an edge's line, moved out by `grown`, in front of the edge itself.
double time_to_edge(const Fall& centre, const Convex& shape, std::size_t i, double grown) {
  constexpr double kRounding = 1e-9;  // of the reach: farther behind an edge's line, the disc is past it
  const Vec &tail = shape.vertices[i], &head = shape.vertices[next(i, shape.vertices.size())];
  const Vec& normal = shape.normals[i];
  const double gap = dot(normal, centre.position - tail) - grown, nearing = -dot(normal, centre.velocity);
  if (gap < -kRounding * grown && nearing > 0.0) return kNever;
  const double time = time_to_line(gap, nearing, -dot(normal, centre.pull), kRounding * grown);
  if (time == kNever) return kNever;
  const Vec at = centre.position + time * centre.velocity + 0.5 * time * time * centre.pull;
  const double along = dot(at - tail, head - tail);
  return along >= 0.0 && along <= dot(head - tail, head - tail) ? time : kNever;
}

}  // namespace

double time_to_line(double gap, double nearing, double pull, double rounding) {
  if (pull == 0.0) return nearing > 0.0 ? std::max(gap, 0.0) / nearing : kNever;
  const double squared = nearing * nearing + 2.0 * pull * gap;
  if (nearing > 0.0) {
    if (gap <= 0.0) return 0.0;
    return squared >= 0.0 ? 2.0 * gap / (nearing + std::sqrt(squared)) : kNever;
  }
  if (!(pull > 0.0)) return kNever;
  if (squared >= 0.0) return (std::sqrt(squared) - nearing) / pull;
  return gap < -rounding ? kNever : -2.0 * nearing / pull;
}

double fall_time(const Fall& centre, double radius, const HalfPlane& free) {
  return time_to_line(dot(free.normal, centre.position - free.point) - radius,
                      -dot(free.normal, centre.velocity), -dot(free.normal, centre.pull), kNever);
}

double fall_time(const Fall& centre, double radius, const Convex& shape, double until) {
  const double grown = radius + shape.radius;
  double time = kNever;
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    const Fall from_vertex{centre.position - shape.vertices[i], centre.velocity, centre.pull};
    time = std::min(time, time_to_point(from_vertex, grown, until));
    if (shape.vertices.size() > 1) time = std::min(time, time_to_edge(centre, shape, i, grown));
  }
  return time < until ? time : kNever;
}

}  // namespace throng::narrowphase
