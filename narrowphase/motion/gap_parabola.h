// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/motion/moving_convex_pair.h"

/// By when two moving shapes are surely still apart.
namespace throng::narrowphase {

/// Where both stand at a time: a's origin in (0, 0), b's at the pair's offset.
struct PlacedPair {
  Pose a, b;
};

/// An axis from a to b that turns at a constant rate.
struct TurningAxis {
  Vec normal;   ///< unit, at the time of the poses
  double spin;  ///< rad/s
  double bend;  ///< m/s², as `bend` says for that spin
};

/// What the gap along an axis is, beyond a margin, and until when it surely is above 0.
struct GapParabola {
  double gap, rate;  ///< m, m/s, of the vertices that are nearest at the time of the poses
  double holds;      ///< s from then, or the `most` asked for; 0 where the gap is not above 0
};

/// The bend of every gap along an axis of that spin, from when the centres are `apart`, on and back: see
/// `bend_of_origins`. With the most that they are apart in some time, also its second derivative there.
double bend(const MovingConvexPair& pair, double spin, double apart);

/// The gap along the axis is at least the least over all pairs of vertices of gap + rate t - bend t² / 2,
/// less `margin`. O(n + m), O(log n + log m) for many vertices.
GapParabola gap_parabola(const MovingConvexPair& pair, const PlacedPair& placed, const TurningAxis& axis,
                         double margin, double most);

/// The same, each vertex bending by how far it is itself from the origin that it turns about, beyond the
/// axis' bend, which is the origins' alone: a corner that stands there goes straight. Holds no shorter; O(n +
/// m), with a square root a vertex.
GapParabola gap_parabola_by_vertex(const MovingConvexPair& pair, const PlacedPair& placed,
                                   const TurningAxis& axis, double margin, double most);

}  // namespace throng::narrowphase
