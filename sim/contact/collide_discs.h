// SPDX-License-Identifier: MIT
#pragma once

#include "sim/contact/contact.h"
#include "sim/plan.h"

namespace throng {

/// Of the reach: deeper overlaps come from the scene, not from collisions.
inline constexpr double kTouchRounding = 1e-9;

/// How two discs touch.
struct DiscTouch {
  Vec normal;                 ///< unit, from a to b
  double radius_a, radius_b;  ///< m
};

/// A collision in no time: restitution along the normal, Coulomb friction across, which stops the slip where
/// it can. Returns the impulse along the normal (N s).
double collide_discs(SolverBody& a, SolverBody& b, const DiscTouch& touch, const Surface& surface);

}  // namespace throng
