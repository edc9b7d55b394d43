// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/scene.h"

/// What the contact solver works on: bodies as it sees them, and contacts. All of it lives for one step; what
/// outlives the step are the impulses in `State`.
namespace throng {

/// `v` turned left by a right angle.
inline Vec tangent(const Vec& v) {
  return {-v.y(), v.x()};
}

/// One body in one cache line: what contacts change stands in its first half.
struct alignas(64) SolverBody {
  Vec velocity;            ///< m/s
  double spin;             ///< rad/s
  double inverse_mass;     ///< 1/kg, 0 for all but dynamic bodies
  Vec position;            ///< m
  double turn;             ///< rad, since the step began
  double inverse_inertia;  ///< 1/(kg m²), as the inverse mass
};
static_assert(sizeof(SolverBody) == 64);

/// What each kind of contact has.
struct ContactBase {
  Vec normal{0.0, 0.0};          ///< unit, from a to b
  std::uint32_t a = 0, b = 0;    ///< rows of the bodies
  double offset = 0.0;           ///< m, separation = offset + normal . (position_b - position_a)
  double normal_mass = 0.0;      ///< kg, what the contact feels along its normal
  double tangent_mass = 0.0;     ///< kg, and across
  double friction = 0.0;         ///< Coulomb's coefficient
  double restitution = 0.0;      ///< 0 to 1
  double lever = 0.0;            ///< m, as in RollContact; for bounces, and 0 where nothing resists rolling
  double normal_impulse = 0.0;   ///< N s, on b; a feels the opposite
  double tangent_impulse = 0.0;  ///< N s, likewise, along the normal turned left
  double preload = 0.0;  ///< N s, of the normal impulse, what it bears without giving way: see Learning
};

/// Two discs, each about its body's centre: the arm is radius times normal, and both are exact in each
/// substep.
struct DiscContact : ContactBase {
  double radius_a = 0.0, radius_b = 0.0;  ///< m
};

/// One point of a manifold. The normal is that of the step's beginning; the arms turn with their bodies, but
/// for a disc's, which points along the normal for ever.
struct PointContact : ContactBase {
  Vec arm_a{0.0, 0.0}, arm_b{0.0, 0.0};      ///< m, from the bodies' centres to the contact, in this substep
  Vec first_a{0.0, 0.0}, first_b{0.0, 0.0};  ///< m, the same at the beginning of the step
  double turns_a = 0.0, turns_b = 0.0;       ///< 1 where the arm turns with the body, 0 for a disc
  double gap = 0.0;   ///< m, separation = gap + normal . (position_b + arm_b - position_a - arm_a)
  bool fast = false;  ///< of a face of two points that doesn't bounce and closes fast as the step begins
};

/// A contact as a damped spring of that stiffness which h, and not the masses, limits. Soft constraints as in
/// Catto, "Solver2D" (2024): rate and scales follow from frequency and damping ratio.
struct Softness {
  double bias_rate;  ///< 1/s, penetration to push-out velocity
  double mass_scale, impulse_scale;
};

/// `hertz`: the spring's frequency; `damping`: its ratio; `h`: the substep (s).
Softness softness(double hertz, double damping, double h);

/// How contacts learn what they bear. A spring gives way to its load, in a pile each layer more; what a
/// contact has learnt, its preload, it bears without, so that what has stood for a while has hardly sunk.
struct Learning {
  static constexpr double kLearnt = 0.8;   ///< of a load: all of it, piles creep
  static constexpr double kMost = 1000.0;  ///< own weights: what bears more swings too slowly

  double share;   ///< of what is missing, in a step: slower than the scene's slowest mode swings, or it rings
  double weight;  ///< m/s, what gravity gives in a substep: times the mass that is felt, its own weight
  double slow;    ///< m/s: bodies that pass each other faster don't stay together for as long as it takes

  /// The preload after a step that ended with that impulse (N s), never more than it. Some of a load is left
  /// to the spring, which brings to rest what friction leaves undetermined; and what bears very many own
  /// weights learns nothing: it swings too slowly.
  /// `speed_squared` (m²/s²): of b against a.
  double operator()(double preload, double normal_impulse, double normal_mass, double speed_squared) const;
};

}  // namespace throng
