// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "tools/bench/accuracy/body_state.h"

namespace throng::bench {

/// A disc of even density.
struct RigidDisc {
  BodyState state;
  double radius;  ///< m
  double mass;    ///< kg
};

/// Two discs that fly, meet at most once and fly on, after t (s). With the normal n from the first to the
/// second, u their relative velocity where they touch and M = 1/m1 + 1/m2: the impulse along n is
/// (1 + e) u.n / M, across it the smaller of what stops the slip, |u.t| / (3 M) (discs: I = m r² / 2), and
/// Coulomb's mu times the one along n. Source: Walton, in Particulate Two-Phase Flow (1993), with his
/// tangential restitution 0; Brach, Mechanical Impact Dynamics (1991).
std::array<BodyState, 2> exact_impact(const std::array<RigidDisc, 2>& discs, double restitution,
                                      double friction, double t);

/// s, when two discs that fly straight touch first; infinite where they don't.
double meeting_time(const RigidDisc& a, const RigidDisc& b);

}  // namespace throng::bench
