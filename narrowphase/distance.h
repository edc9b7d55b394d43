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

/// The exact signed distance of two convex shapes. O(n m) at worst; allocates nothing.
Separation separation(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b);

}  // namespace throng::narrowphase
