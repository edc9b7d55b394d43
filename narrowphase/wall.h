// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/face.h"

/// Walls are segments of no thickness with two sides. A body that one cuts goes back to the side of its
/// centre, which need not be the shortest way out.
namespace throng::narrowphase {

inline bool is_wall(const Convex& shape) {
  return shape.vertices.size() == 2 && shape.radius == 0.0;
}

/// Replaces the widest faces of a wall and of a body that it cuts by those that push the body's centre, the
/// origin of its frame, to the side where it is; a centre on the wall's line goes with the wall's first
/// normal. Beyond an end of the wall, where its side pushes nothing, the widest faces stay: there the
/// shortest way out is right. O(n).
void take_sides(Face& of_wall, Face& of_body, const Convex& wall, const Convex& body,
                const Pose& body_in_wall, const Pose& wall_in_body);

}  // namespace throng::narrowphase
