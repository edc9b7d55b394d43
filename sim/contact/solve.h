// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/contact/body_rows.h"
#include "sim/contact/contact.h"
#include "sim/contact/learning.h"

/// Sequential impulses (Catto 2005) over all contacts, in their order or against it: one sweep of Gauss and
/// Seidel a call.
/// Steps run the same in blocks (disc_blocks.h, face_blocks.h), and this is the definition.
namespace throng {

/// A contact as a damped spring of that stiffness which h, and not the masses, limits. Soft constraints as in
/// Catto, "Solver2D" (2024): rate and scales follow from frequency and damping ratio.
struct Softness {
  double bias_rate;  ///< 1/s, penetration to push-out velocity
  double mass_scale, impulse_scale;
};

/// `hertz`: the spring's frequency; `damping`: its ratio; `h`: the substep (s).
Softness softness(double hertz, double damping, double h);

/// Of velocities: what rounding may make of them where two arrive as a substep ends.
inline constexpr double kNoChange = 1e-9;

struct SolverSettings {
  double h;           ///< s, the substep
  Softness softness;  ///< of the biased sweep
  Learning learning;
  double push_out;  ///< m/s, the fastest that overlapping bodies are driven apart, whatever they bear
  bool friction;    ///< surfaces that meet rub
  /// m: what has a preload may open by so much and stays a spring. As rigid gaps, closed one after the other,
  /// the contacts of what stands high and has hardly sunk would shake each other open.
  double ajar;
  /// A sweep begins with the last contact. In turn from either end, as in symmetric successive
  /// over-relaxation: else all that stands straight is turned to one side.
  bool backward = false;

  /// m/s: an impulse that changes a velocity by no more is none, but rounding.
  double nothing() const { return 1e-12 * push_out; }
};

/// To begin a substep with, before all else here: normals, arms, offsets and separations at the bodies'
/// present positions. `period`: the domain's, or null. `ahead` (s): for so long they go on as they do; the
/// normal of two discs that get past each other by more than kAheadWay in this time is that of when they meet
/// or pass. 0 where nobody gets so far.
void prepare(std::span<DiscContact> contacts, BodyRows<const SolverBody> bodies, const Vec* period,
             double ahead = 0.0);
void prepare(std::span<PointContact> contacts, BodyRows<const SolverBody> bodies);

/// Applies the impulses that the last sweep left.
void warm_start(std::span<const DiscContact> contacts, BodyRows<SolverBody> bodies);
void warm_start(std::span<const PointContact> contacts, BodyRows<SolverBody> bodies);

/// Before the positions move: keeps contacts from closing further than they touch, drives overlapping ones
/// apart softly.
void push_apart(std::span<DiscContact> contacts, BodyRows<SolverBody> bodies, const SolverSettings& settings);
void push_apart(std::span<PointContact> contacts, BodyRows<SolverBody> bodies,
                const SolverSettings& settings);

/// After they moved: takes out again the velocity that push_apart put in.
void relax(std::span<DiscContact> contacts, BodyRows<SolverBody> bodies, const SolverSettings& settings);
void relax(std::span<PointContact> contacts, BodyRows<SolverBody> bodies, const SolverSettings& settings);

/// After the last substep: what contacts learn of what they bear. The points of one face learn as if they
/// bore alike: each on its own would learn a tower's lean, until it falls, as it stands by what they bear
/// more or less than one another.
void learn(std::span<DiscContact> contacts, BodyRows<const SolverBody> bodies, const Learning& learning);
void learn(std::span<PointContact> contacts, BodyRows<const SolverBody> bodies, const Learning& learning);

}  // namespace throng
