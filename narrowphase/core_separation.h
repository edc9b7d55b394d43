// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/convex.h"

/// The separation of two shapes without their radii, in the frame of the first; `separation` adds radii and
/// frames.
namespace throng::narrowphase {

struct CoreSeparation {
  double distance;  ///< m, signed
  Vec normal;       ///< unit, from the first to the second
  Vec point;        ///< m, on the first, nearest to or deepest in the second
};

/// Two points, `offset` from the first to the second. Where they coincide the normal is the x axis.
CoreSeparation disc_disc(const Vec& centre, const Vec& offset);

/// A point against a polygon or a segment. Inside a polygon: the nearest edge, the first of several. On a
/// segment's line: its first normal. O(n).
CoreSeparation polygon_disc(const Convex& polygon, const Vec& point);

/// The same for a point known to be outside, up to rounding: never negative.
CoreSeparation nearest(const Convex& polygon, const Vec& point);

/// Polygons or segments. Overlap: the least depth over the edge normals of both. Segments are solids of zero
/// thickness: two that cross are as deep in each other as the shortest way out, collinear ones 0 deep.
/// O(n + m) plus O(n + m) for each vertex that may be nearest, mostly two or three.
CoreSeparation polygon_polygon(const Convex& a, const Convex& b, const Pose& b_in_a);

}  // namespace throng::narrowphase
