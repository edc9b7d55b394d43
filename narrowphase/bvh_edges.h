// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "narrowphase/crossing.h"
#include "narrowphase/orientation.h"
#include "narrowphase/relative.h"

/// Two edges, and an edge and a point, in one frame: what stands in the leaves of an outline's hierarchy.
namespace throng::narrowphase {

/// A point on an edge and how far it is. m².
struct EdgePoint {
  double squared;
  Vec point;
};

/// From `x` to the closed edge p-q; across its middle by the height over it, which keeps its digits.
inline EdgePoint nearest_on_edge(const Vec& x, const Vec& p, const Vec& q) {
  const Vec edge = q - p, from_p = x - p;
  const double along = dot(from_p, edge), length2 = dot(edge, edge);
  if (along <= 0.0) return {dot(from_p, from_p), p};
  if (along >= length2) return {dot(x - q, x - q), q};
  const double height = cross(edge, from_p);
  return {height / length2 * height, p + along / length2 * edge};
}

/// The nearest points of two edges; where they meet, or the nearest is 0, squared is 0 and both are one
/// point.
struct EdgePairPoints {
  double squared;
  Vec on_a, on_b;
};

/// Where p-q and r-s, which meet, do so, up to rounding.
inline Vec meeting_point(const Vec& p, const Vec& q, const Vec& r, const Vec& s) {
  const double before = cross(s - r, p - r), after = cross(s - r, q - r);
  const double span = before - after;
  return span == 0.0 ? p : Vec(p + std::clamp(before / span, 0.0, 1.0) * (q - p));
}

inline EdgePairPoints nearest_of_edges(const Vec& p, const Vec& q, const Vec& r, const Vec& s) {
  const EdgePoint of_r = nearest_on_edge(r, p, q), of_s = nearest_on_edge(s, p, q);
  const EdgePoint of_p = nearest_on_edge(p, r, s), of_q = nearest_on_edge(q, r, s);
  EdgePairPoints best{of_r.squared, of_r.point, r};
  if (of_s.squared < best.squared) best = {of_s.squared, of_s.point, s};
  if (of_p.squared < best.squared) best = {of_p.squared, p, of_p.point};
  if (of_q.squared < best.squared) best = {of_q.squared, q, of_q.point};
  if (!segments_meet(p, q, r, s)) return best;
  const Vec at = meeting_point(p, q, r, s);
  return {0.0, at, at};
}

/// The unit vector from the nearest point on p-q to that on r-s, which are apart: from an end to the middle
/// of the other edge it is that edge's normal, which keeps its digits however near the two are.
inline Vec normal_of_edges(const EdgePairPoints& nearest, const Vec& p, const Vec& q, const Vec& r,
                           const Vec& s) {
  const Vec between = nearest.on_b - nearest.on_a;
  const bool ends_at_a = nearest.on_a == p || nearest.on_a == q;
  const bool ends_at_b = nearest.on_b == r || nearest.on_b == s;
  if (ends_at_a && ends_at_b) return direction(between, {1.0, 0.0}).unit;
  const Vec along = direction(ends_at_a ? s - r : q - p, {0.0, 1.0}).unit, left{-along.y(), along.x()};
  return dot(left, between) < 0.0 ? Vec(-left) : left;
}

/// Whether the ray from `x` towards +x passes p-q, its upper end left out: the even-odd rule counts these.
inline bool ray_passes(const Vec& x, const Vec& p, const Vec& q) {
  if ((p.y() > x.y()) == (q.y() > x.y())) return false;
  return orientation(p, q, x) == (q.y() > p.y() ? 1 : -1);
}

}  // namespace throng::narrowphase
