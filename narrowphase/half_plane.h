// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/manifold.h"

namespace throng::narrowphase {

/// All of the plane where normal . (x - point) >= 0; beyond its border all is solid. A box domain is four of
/// them.
struct HalfPlane {
  Vec point;   ///< m, world, anywhere on the border
  Vec normal;  ///< unit, into the free side
};

/// How far the shape keeps from the border: below 0 it is that deep in the solid side. O(n); m.
double clearance(const Convex& shape, const Pose& pose, const HalfPlane& free);

/// The contact of a shape with the border: its deepest vertex and the deeper of that one's neighbours, as far
/// as they are within `reach`. The normal is -free.normal, from the shape into the solid side. The feature is
/// the vertex. O(n).
Manifold manifold(const Convex& shape, const Pose& pose, const HalfPlane& free, double reach);

}  // namespace throng::narrowphase
