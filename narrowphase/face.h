// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// An edge of one polygon and the vertex of another that lies deepest behind it.
struct Face {
  double separation;  ///< m, of that vertex from the edge's line, outward; without radii
  std::size_t edge, vertex;
};

/// The edge of `a` that keeps `b` farthest outside: above 0 its line separates the two. Ties go to the first
/// edge and the first vertex. Expects 2 vertices or more in a, 1 or more in b; `b_in_a` as of `relative`. O(n
/// + m), and O(n m) of a fraction of a nanosecond where b has 32 vertices or fewer.
Face widest_face(const Convex& a, const Convex& b, const Pose& b_in_a);

/// The face of `a` with that edge. O(m).
Face face_at(const Convex& a, std::size_t edge, const Convex& b, const Pose& b_in_a);

/// The edge of `shape` at its deepest vertex that looks most against a face whose normal, in the shape's
/// frame, is `normal`.
std::size_t incident_edge(const Convex& shape, std::size_t deepest, const Vec& normal);

/// The widest face of each of two shapes.
struct Faces {
  Face of_a, of_b;

  bool a_is_wider() const { return of_a.separation >= of_b.separation; }
  const Face& widest() const { return a_is_wider() ? of_a : of_b; }
};

Faces widest_faces(const Convex& a, const Convex& b, const Pose& b_in_a, const Pose& a_in_b);

/// The edge of `a` that looks most towards b's origin: mostly enough to see that the two are apart. O(n + m).
Face facing_face(const Convex& a, const Convex& b, const Pose& b_in_a);

}  // namespace throng::narrowphase
