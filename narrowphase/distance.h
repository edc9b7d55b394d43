// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// How far apart two solids are, or how deep in each other.
struct Separation {
  double distance;  ///< m, signed: below 0 it is minus the penetration depth
  Vec normal;       ///< unit, from a to b, also where the shapes overlap or coincide
  Vec point_a;      ///< m, world: on the surface of a, nearest to (or deepest in) b
  Vec point_b;      ///< m, world: point_a + distance * normal
};

/// The exact signed distance of two convex shapes, up to rounding at the scale of their coordinates relative
/// to each other. Swapping a and b swaps the points and flips the normal, to the bit (two equal shapes in
/// equal places apart). Segments have no inside: where two cross, or one crosses a polygon, the depth is the
/// shortest way out; the centre of a disc exactly on a segment takes its first normal; coincident discs take
/// the x axis. For pairs that meet once; `track` of tracker.h remembers. O(n + m) for few vertices, O(log n +
/// log m) for many that are apart, O(n + m) for the depth of those that overlap; where hardly anything parts
/// the two, O(n m) at worst. Allocates nothing.
Separation separation(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b);

}  // namespace throng::narrowphase
