// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "sim/plan.h"
#include "sim/scene.h"

/// Who is fast? Each stage asks for something else:
///  * what comes nearer at hit_speed() hits: it is stopped before the sweeps, see find_hits.cpp;
///  * what meets more slowly than kRestSpeed rests, though its surface bounces;
///  * two that get past each other by more than kAheadWay in a step press as they will meet: see LookAhead;
///  * discs that get no farther than half their radius in a step press along walls that bend by its middle:
///    see touch_midway();
///  * polygons that are slower than both, hit_speed() and kAheadWay in a step, may be held: see HeldFaces,
///    which looks at those alone whose faces will last for some steps;
///  * what touches a face that turns by more than kFaceTurn goes with it: see TurningFaces;
///  * bodies that turn by more than kFarTurn feel masses as their arms are then;
///  * bodies that pass each other slowly learn what they bear: see Learning::slow;
///  * bodies that get farther in a step than to each other's hearts may have to be guarded: see Guard;
///  * bodies that are slow for long enough fall asleep: see Sleepers.
namespace throng {

/// m/s, what gravity gives in four substeps; 0 where nothing falls: whatever comes nearer hits.
inline double hit_speed(const Scene& scene, const Plan& plan) {
  return plan.gravity ? 4.0 * scene.gravity.norm() * plan.substep : 0.0;
}

/// Of what gravity gives in a substep.
inline constexpr double kRestSpeed = 2.0;

/// Of the smaller radius.
inline constexpr double kAheadWay = 0.02;

/// rad, in a step.
inline constexpr double kFaceTurn = 5e-4, kFarTurn = 0.1;

/// Whether the faces of who spins so (rad/s) turn far within a step of `dt` (s).
inline bool turns_far(double spin, double dt) {
  return std::abs(spin) * dt > kFaceTurn;
}

}  // namespace throng
