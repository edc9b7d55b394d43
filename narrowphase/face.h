// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// An edge of one polygon and the vertex of another that lies deepest behind it.
struct Face {
  double separation;  ///< m, of that vertex from the edge's line, outward; without radii
  std::size_t edge, vertex;
};

/// The edge of `a` that keeps `b` farthest outside: above 0 its line separates the two. Ties go to the edge
/// that comes first after the one that faces b's origin. Expects 2 vertices or more in a, 1 in b; `b_in_a` as
/// of `relative`. O(n + m): from edge to edge the deepest vertex only moves on. Returns at the first
/// separation above `enough`.
Face widest_face(const Convex& a, const Convex& b, const Pose& b_in_a,
                 double enough = std::numeric_limits<double>::infinity());

}  // namespace throng::narrowphase
