// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/scene.h"

/// What the contact solver works on: bodies as it sees them, and contacts. All of it lives for one step; what
/// outlives the step are the impulses in `State`.
namespace throng {

/// One body in one cache line.
struct alignas(64) SolverBody {
  Vec position;            ///< m
  Vec velocity;            ///< m/s
  double spin;             ///< rad/s
  double turn;             ///< rad, since the step began
  double inverse_mass;     ///< 1/kg, 0 for all but dynamic bodies
  double inverse_inertia;  ///< 1/(kg m²), likewise
};
static_assert(sizeof(SolverBody) == 64);

/// What each kind of contact has.
struct ContactBase {
  Vec normal;                        ///< unit, from a to b
  std::uint32_t a, b;                ///< rows of the bodies
  double offset;                     ///< m, separation = offset + normal . (position_b - position_a)
  double normal_mass, tangent_mass;  ///< kg, what the contact feels along and across its normal
  double friction, restitution;
  double normal_impulse, tangent_impulse;  ///< N s, on b; a feels the opposite
};

/// Two discs, each about its body's centre: the arm is radius times normal, and both are exact in each
/// substep.
struct DiscContact : ContactBase {
  double radius_a, radius_b;  ///< m
};

/// One point of a manifold. The normal is that of the step's beginning; the arms turn with their bodies, but
/// for a disc's, which points along the normal for ever.
struct PointContact : ContactBase {
  Vec arm_a, arm_b;         ///< m, from the bodies' centres to the contact, in this substep
  Vec first_a, first_b;     ///< m, the same at the beginning of the step
  double turns_a, turns_b;  ///< 1 where the arm turns with the body, 0 for a disc
  double gap;               ///< m, separation = gap + normal . (position_b + arm_b - position_a - arm_a)
};

/// A contact as a damped spring of that stiffness which h, and not the masses, limits. Soft constraints as in
/// Catto, "Solver2D" (2024): rate and scales follow from frequency and damping ratio.
struct Softness {
  double bias_rate;  ///< 1/s, penetration to push-out velocity
  double mass_scale, impulse_scale;
};

/// `hertz`: the spring's frequency; `damping`: its ratio; `h`: the substep (s).
Softness softness(double hertz, double damping, double h);

}  // namespace throng
