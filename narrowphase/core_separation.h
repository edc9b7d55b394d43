// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "narrowphase/distance.h"
#include "narrowphase/face.h"

/// The separation of two shapes without their radii, in the frame of the first.
namespace throng::narrowphase {

struct CoreSeparation {
  double distance;  ///< m, signed
  Vec normal;       ///< unit, from the first to the second
  Vec point;        ///< m, on the first, nearest to or deepest in the second
};

/// Of the lengths that a separation is made of, what rounding may do to it: eight unit roundoffs.
constexpr double kCoreRounding = 8.0 * 0x1p-53;

/// Two points, `offset` from the first to the second. Where they coincide the normal is the x axis.
CoreSeparation disc_disc(const Vec& centre, const Vec& offset);

/// A point against a polygon or a segment. Inside a polygon: the nearest edge, the first of several. On a
/// segment's line: its first normal. Where one edge's line alone keeps the point more than `enough` away,
/// that lower bound of the distance may stand for it. O(n).
CoreSeparation polygon_disc(const Convex& polygon, const Vec& point,
                            double enough = std::numeric_limits<double>::infinity());

/// The same for a point known to be outside, up to rounding: never negative.
CoreSeparation nearest(const Convex& polygon, const Vec& point);

/// Polygons or segments. Overlap: the least depth over the edge normals of both. Segments are solids of zero
/// thickness: two that cross are as deep in each other as the shortest way out, collinear ones 0 deep.
/// Expects the widest faces of the two. O(n + m) plus O(n + m) for each vertex that may be nearest, mostly
/// two or three.
CoreSeparation polygon_polygon(const Convex& a, const Convex& b, const Pose& b_in_a, const Faces& faces);

/// With radii, in the world.
inline Separation in_world(const Convex& a, const Pose& pose_a, const Convex& b, const CoreSeparation& core) {
  const double distance = core.distance - (a.radius + b.radius);
  const Vec normal = pose_a.rotate(core.normal);
  const Vec point = pose_a * (core.point + a.radius * core.normal);
  return {distance, normal, point, point + distance * normal};
}

}  // namespace throng::narrowphase
