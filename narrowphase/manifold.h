// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// The face on which a manifold is described.
struct Reference {
  std::uint32_t edge = 0;
  bool of_b = false;   ///< the edge is b's, else a's
  bool known = false;  ///< false: there is none, as where a disc is among the two
};

/// One point at which two shapes touch or nearly do.
struct ManifoldPoint {
  Vec point{0.0, 0.0};        ///< m, world, midway between the two surfaces
  double separation = 0.0;    ///< m, along the manifold's normal; below 0 in penetration
  std::uint32_t feature = 0;  ///< names the pair of features, the same while they stay in touch, and the
                              ///< reference
};

/// Up to two points that share a normal: what a contact solver needs of a pair of convex shapes.
struct Manifold {
  Vec normal{0.0, 0.0};  ///< unit, from a to b
  int count = 0;
  std::array<ManifoldPoint, 2> points;
};

/// m: infinite where there is no point.
inline double least_separation(const Manifold& manifold) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < manifold.count; ++i) least = std::min(least, manifold.points[i].separation);
  return least;
}

/// Of the shorter of two faces: by so much the one that isn't the reference may be wider. More would press in
/// what the wider face lets go: from 2^-16 on the deepest overlap of a pyramid at rest grows by 6 %; the mean
/// doesn't.
constexpr double kMuchWider = 0x1p-18;

/// The contact manifold of two convex shapes; empty where they are more than `reach` apart. Allocates
/// nothing.
///
/// The reference is the face that keeps the other shape farthest outside. Faces that do so equally well would
/// take turns with each rounding: `kept`, the last manifold's, stays until another is wider by 2^-18 (four
/// millionths) of the shorter of the two. Any value may be passed, of whatever shapes; the manifold depends
/// on nothing else.
Manifold manifold(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, double reach,
                  const Reference& kept = {});

/// What of `body` lies over the face `edge` of `part`, within `reach`, on that face; empty of a disc and
/// where nothing does. The normal points from the part to the body; `part_is_b`: names are those of a
/// manifold whose b is the part.
Manifold manifold_on_face(const Convex& part, const Pose& part_pose, std::size_t edge, const Convex& body,
                          const Pose& body_pose, double reach, bool part_is_b);

/// A point of a manifold on a face: an end of the incident edge over the face, or the place of it over an end
/// of the face.
enum class EndOf : std::uint8_t { head, tail, above_tail, above_head };

/// The features of all of them. `of_b`: the reference is b, the incident shape is a.
std::array<std::uint32_t, 4> end_names(const Convex& reference, std::size_t edge, const Convex& incident,
                                       std::size_t incident_edge, bool of_b);

/// Whether the point is one of a face and an edge on it, not of two corners and not of a disc.
bool is_on_face(std::uint32_t feature);

/// A point's `feature` but for the reference: what outlives a change of it.
std::uint32_t without_reference(std::uint32_t feature);

/// Whether the manifold was described on b's face, so that its points run the other way.
bool reference_is_b(std::uint32_t feature);

/// The reference of the manifold of a and b that a point belonged to, out of its `feature`.
Reference reference(std::uint32_t feature, const Convex& a, const Convex& b);

}  // namespace throng::narrowphase
