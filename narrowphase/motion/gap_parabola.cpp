// SPDX-License-Identifier: MIT
#include "narrowphase/motion/gap_parabola.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/motion/parabola.h"
#include "narrowphase/support.h"

namespace throng::narrowphase {

namespace {

/// The vertex that comes farthest, and how it bends by itself.
struct Extreme {
  const Vec& vertex;
  double bend;
};

/// How one shape's vertices lie along the axis, in the shape's frame: dot(normal, v) + time * dot(drift, v).
struct Side {
  const Convex& shape;
  Vec normal, drift;

  /// Along the axis, `sign` 1, or back, -1, at a time from now.
  Extreme extreme(double sign, double time) const {
    return {shape.vertices[support(shape, sign * (normal + time * drift))], 0.0};
  }
};

/// The same with each vertex' own bend.
struct BendingSide : Side {
  double turning;  ///< rad/s, in the axis' frame
  double reach;    ///< m, of all vertices about the middle of a shape that doesn't spin
  bool spins;      ///< about its origin

  double bend(const Vec& v) const {
    return bend_of_vertex(turning, spins ? direction(v, {1.0, 0.0}).length : reach);
  }

  Extreme extreme(double sign, double time) const {
    const Vec along = sign * (normal + time * drift);
    const auto height = [&](const Vec& v) { return dot(along, v) + 0.5 * time * time * bend(v); };
    const Vec* best = &shape.vertices[0];
    double most = height(*best);
    for (const Vec& v : shape.vertices)
      if (const double h = height(v); h > most) best = &v, most = h;
    return {*best, bend(*best)};
  }
};

Side side(const Convex& shape, const Pose& pose, double spin, const TurningAxis& axis) {
  const Vec n = pose.unrotate(axis.normal);
  return {shape, n, (spin - axis.spin) * Vec{n.y(), -n.x()}};
}

BendingSide bending(const Side& side, double spin, double reach, const TurningAxis& axis) {
  return {side, spin - axis.spin, reach, spin != 0.0};
}

/// The gap along an axis over all vertices: the lowest of parabolas.
template <class OneSide>
struct Lowest {
  OneSide a, b;
  Parabola origins;

  Parabola at(double time) const {
    const Extreme p = a.extreme(1.0, time), q = b.extreme(-1.0, time);
    return {origins.gap + dot(b.normal, q.vertex) - dot(a.normal, p.vertex),
            origins.rate + dot(b.drift, q.vertex) - dot(a.drift, p.vertex), origins.bend + p.bend + q.bend};
  }
};

Parabola of_origins(const MovingConvexPair& pair, const PlacedPair& placed, const TurningAxis& axis,
                    double margin) {
  const Vec &n = axis.normal, &offset = placed.b.position;
  return {dot(n, offset) - pair.radius - margin, rate_of_origins(n, axis.spin, pair.velocity, offset),
          axis.bend};
}

template <class OneSide>
GapParabola lowest_root(const Lowest<OneSide>& all, double most) {
  const Parabola now = all.at(0.0);
  if (!(now.gap > 0.0)) return {now.gap, now.rate, 0.0};
  double holds = std::min(most, now.root());
  // The lowest of such parabolas only bends down: from root to root of who is lowest there, never back.
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

}  // namespace

double bend(const MovingConvexPair& pair, double spin, double apart) {
  return bend_of_origins(spin, pair.speed, apart) + bend_of_vertex(pair.spin_a - spin, pair.reach_a) +
         bend_of_vertex(pair.spin_b - spin, pair.reach_b);
}

GapParabola gap_parabola(const MovingConvexPair& pair, const PlacedPair& placed, const TurningAxis& axis,
                         double margin, double most) {
  const Side a = side(pair.a, placed.a, pair.spin_a, axis), b = side(pair.b, placed.b, pair.spin_b, axis);
  return lowest_root(Lowest<Side>{a, b, of_origins(pair, placed, axis, margin)}, most);
}

GapParabola gap_parabola_by_vertex(const MovingConvexPair& pair, const PlacedPair& placed,
                                   const TurningAxis& axis, double margin, double most) {
  const Side a = side(pair.a, placed.a, pair.spin_a, axis), b = side(pair.b, placed.b, pair.spin_b, axis);
  const Lowest<BendingSide> all{bending(a, pair.spin_a, pair.reach_a, axis),
                                bending(b, pair.spin_b, pair.reach_b, axis),
                                of_origins(pair, placed, axis, margin)};
  return lowest_root(all, most);
}

}  // namespace throng::narrowphase
