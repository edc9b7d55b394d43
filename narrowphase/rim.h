// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/manifold.h"

/// Where convex parts meet: bodies that slide over the seam between two parts of one solid, or of one wall,
/// must not catch on corners that the whole doesn't have. A part's rim tells which corners are real.
namespace throng::narrowphase {

/// How the outline of the whole goes on at an end of an edge, as seen from outside.
enum class Turn : std::uint8_t { convex, flat, concave };

/// One edge of a part as a piece of that outline.
struct RimEdge {
  bool inner = false;  ///< another part lies behind: nothing from outside touches it
  Turn at_tail = Turn::convex, at_head = Turn::convex;
  Vec before{0.0, 0.0}, after{0.0, 0.0};           ///< outward unit normals of the outline's edges there
  bool solid_before = false, solid_after = false;  ///< whether those, and this one, are solids', not walls'
};

/// Of each edge of a part; empty for a part that meets no other.
using Rim = std::vector<RimEdge>;

/// The rims of parts that stand in one frame and don't move against each other. Those meet that share a
/// vertex but for rounding (`weld`); two that share an edge have it as a seam. A segment has two edges, one a
/// side. Turns below a millionth are flat. O(n log n), n = edges.
std::vector<Rim> rims(std::span<const Convex> parts);

/// Whether at an end of the part its outline goes on with a turn, but of no more than 0.01 rad: too little
/// for the part beyond to hold a body alone (on_outline()). O(edges).
bool bends_gently(const Convex& part, const Rim& rim);

/// One of the two shapes of a manifold, and where it stands.
struct PlacedConvex {
  const Convex& shape;
  const Pose& pose;
};

/// What is left of the contact of a part and a body within `reach` once the part is a piece of its whole,
/// whose `rim` isn't empty. Normals point from the part to the body, here and in the result.
///
/// A normal that leans further than the outline does at that corner belongs to no corner of the whole. In a
/// hollow the part's face presses instead. Anywhere else the nearest normal that the outline has there takes
/// its place. Where the outline goes straight on, each part holds what of a polygon is over its face, however
/// the polygon leans: what rocks over a seam is let go by neither. Elsewhere, and for discs, the contact
/// stays if the body's deepest vertex is over this part; if it is beyond, the part beyond holds it, and this
/// contact is dropped, as by the smooth chains of Box2D (Catto, 2020). `part_is_b`: of the pair that points
/// are named for. O(n).
Manifold on_outline(const Manifold& m, const PlacedConvex& part, const Rim& rim, const PlacedConvex& body,
                    double reach, bool part_is_b);

}  // namespace throng::narrowphase
