// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "narrowphase/convex.h"

/// What a stranger's polygon goes through before it becomes a shape. All decisions are exact.
namespace throng::narrowphase {

/// A simple polygon, counter-clockwise, without duplicate or collinear vertices; or why it can't be had.
struct Cleaned {
  std::vector<Vec> vertices;
  std::vector<std::size_t> given;    ///< of each vertex, which of those given it was
  std::vector<std::string> repairs;  ///< what was harmless and mended, a sentence each
  std::string refusal;               ///< what can't be mended; empty if the polygon is usable
};

/// Welds equal neighbours (a first vertex repeated at the end is no repair) and vertices on the straight line
/// between theirs, turns a clockwise polygon round. Refuses what is not finite or beyond 1e100 m, has a
/// coordinate below 1e-140 m that is not 0, has fewer than three different vertices or no area, crosses,
/// touches or folds back on itself; vertices are counted from 0 as given. O(n log n) as `find_crossing`.
Cleaned clean(std::span<const Vec> vertices);

/// The same of a hole, which comes out clockwise and may be given either way.
Cleaned clean_hole(std::span<const Vec> vertices);

/// The edge from this vertex to the next by the vertices as given, such as "edge 0-3".
std::string edge_name(const Cleaned& polygon, std::size_t edge);

struct MassProperties {
  double area = 0.0;       ///< m²
  Vec centroid{0.0, 0.0};  ///< m
  double gyration2 = 0.0;  ///< m², moment of inertia about the centroid over mass
};

/// Of a simple polygon, counter-clockwise. Taken about the polygon itself: its place costs no digits. O(n).
MassProperties mass_properties(std::span<const Vec> polygon);

/// Of a polygon with holes, which run clockwise, as `clean` of holes.h gives it. Holes that leave 1e-k of the
/// outline's area cost area and centroid k digits.
MassProperties mass_properties(std::span<const std::vector<Vec>> rings);

}  // namespace throng::narrowphase
