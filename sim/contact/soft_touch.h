// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/convex.h"
#include "narrowphase/half_plane.h"

/// Where a point is nearest to the surface of a solid.
namespace throng {

using narrowphase::Vec;

/// The surface beside a point.
struct NearestSurface {
  double distance;  ///< m, from the point to the surface; below 0 the point is inside
  Vec normal;       ///< unit, from the point into the solid
};

NearestSurface nearest_surface(const Vec& point, const narrowphase::HalfPlane& free);

/// Of a convex part that stands at `pose`. A segment has two sides and no inside. O(n), n its vertices.
NearestSurface nearest_surface(const Vec& point, const narrowphase::Convex& part,
                               const narrowphase::Pose& pose);

}  // namespace throng
