// SPDX-License-Identifier: MIT
#include "narrowphase/motion/gap_parabola.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/support.h"

namespace throng::narrowphase {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// How one shape's vertices lie along the axis, in the shape's frame: dot(normal, v) + time * dot(drift, v).
struct Side {
  const Convex& shape;
  Vec normal, drift;

  /// The vertex that comes farthest along the axis, `sign` 1, or back, -1, at a time from now.
  const Vec& extreme(double sign, double time) const {
    return shape.vertices[support(shape, sign * (normal + time * drift))];
  }
};

Side side(const Convex& shape, const Pose& pose, double spin, const TurningAxis& axis) {
  const Vec n = pose.unrotate(axis.normal);
  return {shape, n, (spin - axis.spin) * Vec{n.y(), -n.x()}};
}

/// gap + rate t - bend t² / 2
struct Parabola {
  double gap, rate, bend;

  double at(double t) const { return gap + t * (rate - 0.5 * bend * t); }

  /// Where it comes down to 0; expects gap > 0.
  double root() const {
    const double r = std::sqrt(rate * rate + 2.0 * bend * gap);
    if (rate < 0.0) return 2.0 * gap / (r - rate);
    return bend > 0.0 ? (r + rate) / bend : kInfinity;
  }
};

/// The gap along an axis over all vertices: the lowest of parabolas of one bend.
struct Lowest {
  Side a, b;
  double gap, rate, bend;  ///< of the origins

  Parabola at(double time) const {
    const Vec &p = a.extreme(1.0, time), &q = b.extreme(-1.0, time);
    return {gap + dot(b.normal, q) - dot(a.normal, p), rate + dot(b.drift, q) - dot(a.drift, p), bend};
  }
};

Lowest lowest(const MovingConvexPair& pair, const PlacedPair& placed, const TurningAxis& axis,
              double margin) {
  const Vec &n = axis.normal, &offset = placed.b.position;
  return {side(pair.a, placed.a, pair.spin_a, axis), side(pair.b, placed.b, pair.spin_b, axis),
          dot(n, offset) - pair.radius - margin, dot(n, pair.velocity) + axis.spin * cross(n, offset),
          axis.bend};
}

}  // namespace

double bend(const MovingConvexPair& pair, double spin, double farthest) {
  const double of_a = pair.spin_a - spin, of_b = pair.spin_b - spin;
  return std::abs(spin) * (2.0 * pair.speed + std::abs(spin) * farthest) + of_a * of_a * pair.reach_a +
         of_b * of_b * pair.reach_b;
}

GapParabola gap_parabola(const MovingConvexPair& pair, const PlacedPair& placed, const TurningAxis& axis,
                         double margin, double most) {
  const Lowest all = lowest(pair, placed, axis, margin);
  const Parabola now = all.at(0.0);
  if (!(now.gap > 0.0)) return {now.gap, now.rate, 0.0};
  double holds = std::min(most, now.root());
  // Bend aside, the lowest of straight lines only bends down: from root to root of who is lowest there, never
  // back.
  constexpr int kMost = 6;
  for (int i = 0; i < kMost; ++i) {
    const Parabola then = all.at(holds);
    const double height = then.at(holds);
    if (height >= 0.0) break;
    const double chord = holds * now.gap / (now.gap - height);  // which lies below
    holds = i + 1 == kMost || then.gap <= 0.0 ? chord : std::min(holds, then.root());
  }
  return {now.gap, now.rate, holds};
}

}  // namespace throng::narrowphase
