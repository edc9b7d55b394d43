// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/neighbours.h"
#include "sim/scene.h"

/// Which way one looks, and how wide.
namespace throng {

/// The unit vector `degrees` counter-clockwise from the x axis, exact on the axes and the diagonals.
Vec direction(double degrees);

/// The unit vector at `angle` (rad).
Vec direction_of_angle(double angle);

/// A view so many degrees wide, above 0 and at most 360.
broadphase::FieldOfView field_of_view(double degrees);

/// Where a body looks: along its angle; an agent where it walks. Who stands looks all around, with a heading
/// of zero.
inline Vec heading(BodyKind kind, double angle, const Vec& velocity) {
  return kind == BodyKind::agent ? velocity : direction_of_angle(angle);
}

}  // namespace throng
