// SPDX-License-Identifier: MIT
#include "narrowphase/exhaustive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace throng::narrowphase {

namespace {

using Real = long double;

struct RealPoint {
  Real x, y;
  friend RealPoint operator+(RealPoint p, RealPoint q) { return {p.x + q.x, p.y + q.y}; }
  friend RealPoint operator-(RealPoint p, RealPoint q) { return {p.x - q.x, p.y - q.y}; }
  friend RealPoint operator*(Real s, RealPoint p) { return {s * p.x, s * p.y}; }
  friend Real dot(RealPoint p, RealPoint q) { return p.x * q.x + p.y * q.y; }
  friend Real length(RealPoint p) { return std::sqrt(dot(p, p)); }
};

Vec rounded(RealPoint p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y)};
}
RealPoint exact(const Vec& v) {
  return {v.x(), v.y()};
}

using RealPoints = std::vector<RealPoint>;

/// The vertices in the world's directions, about `origin`.
RealPoints placed(const Convex& shape, const Pose& pose, const Vec& origin) {
  RealPoints points;
  for (const Vec& v : shape.vertices) {
    const RealPoint p{Real{pose.cos} * v.x() - Real{pose.sin} * v.y(),
                      Real{pose.sin} * v.x() + Real{pose.cos} * v.y()};
    points.push_back(p + (exact(pose.position) - exact(origin)));
  }
  return points;
}

struct Answer {
  Real distance;
  RealPoint normal, on_a, on_b;
};

RealPoint nearest_on_segment(RealPoint p, RealPoint tail, RealPoint head) {
  const RealPoint edge = head - tail;
  const Real squared = dot(edge, edge);
  if (squared == 0) return tail;
  return tail + std::clamp(dot(p - tail, edge) / squared, Real{0}, Real{1}) * edge;
}

/// The nearest points of the two outlines.
Answer nearest_points(const RealPoints& a, const RealPoints& b) {
  Answer best{std::numeric_limits<Real>::infinity(), {1, 0}, {0, 0}, {0, 0}};
  const auto consider = [&best](RealPoint p, RealPoint q) {
    const Real d = length(q - p);
    if (d < best.distance) best = {d, d > 0 ? (1 / d) * (q - p) : RealPoint{1, 0}, p, q};
  };
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      consider(nearest_on_segment(b[j], a[i], a[(i + 1) % a.size()]), b[j]);
      consider(a[i], nearest_on_segment(a[i], b[j], b[(j + 1) % b.size()]));
    }
  return best;
}

/// The free stretch between the two along a direction; below 0 they overlap by as much.
Answer gap_along(const RealPoints& a, const RealPoints& b, RealPoint normal) {
  const auto less = [&](RealPoint p, RealPoint q) { return dot(normal, p) < dot(normal, q); };
  const RealPoint p = *std::max_element(a.begin(), a.end(), less),
                  q = *std::min_element(b.begin(), b.end(), less);
  const Real gap = dot(normal, q - p);
  return {gap, normal, q - gap * normal, q};
}

/// The widest gap over the normals of all edges of `shape`, both ways round where `sign` is -1.
void widen(Answer& best, const RealPoints& a, const RealPoints& b, const RealPoints& shape, Real sign) {
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const RealPoint edge = shape[(i + 1) % shape.size()] - shape[i];
    const Real size = length(edge);
    if (size == 0) continue;
    const Answer found = gap_along(a, b, {sign * edge.y / size, -sign * edge.x / size});
    if (found.distance > best.distance) best = found;
  }
}

Answer cores(const RealPoints& a, const RealPoints& b) {
  const Answer apart = nearest_points(a, b);
  if (gap_along(a, b, apart.normal).distance > apart.distance / 2) return apart;
  Answer overlap{-std::numeric_limits<Real>::infinity(), {1, 0}, {0, 0}, {0, 0}};
  widen(overlap, a, b, a, 1);
  widen(overlap, a, b, b, -1);
  return std::isfinite(overlap.distance) ? overlap : apart;
}

}  // namespace

Separation exhaustive_separation(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b) {
  const Answer core = cores(placed(a, pose_a, pose_a.position), placed(b, pose_b, pose_a.position));
  const Real distance = core.distance - (Real{a.radius} + b.radius);
  const RealPoint on_a = core.on_a + Real{a.radius} * core.normal + exact(pose_a.position);
  return {static_cast<double>(distance), rounded(core.normal), rounded(on_a),
          rounded(on_a + distance * core.normal)};
}

}  // namespace throng::narrowphase
