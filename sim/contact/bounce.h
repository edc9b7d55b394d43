// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/contact/contact.h"

/// Bounces, before the sweeps of a substep: one pair after the other as in Guendelman, Bridson and Fedkiw
/// (2003), where bodies would meet in this substep.
namespace throng {

/// What of a substep bounces.
struct BounceRule {
  double h;          ///< s, the substep
  double threshold;  ///< m/s: what meets more slowly rests
  double hit_speed;  ///< m/s: what hits is stopped from then on, although it doesn't bounce
  Vec kick;          ///< m/s, what gravity adds to a dynamic body's velocity in the substep
};

/// Lets all bounce once that would meet: one contact after the other, but those that two bodies have with
/// each other, one after the other in the list, as one impact where they have one normal. What doesn't bounce
/// is left to the sweeps, but for what hits: it is stopped at the other's surface, whatever other surfaces of
/// the scene do. To be called after prepare() and before gravity acts: then the flight after a bounce with e
/// = 1 mirrors the one before, and energy stays. Returns whether anything bounced: call again until nothing
/// does. O(contacts), and that of a pair's squared where these meet.
bool bounce(std::span<DiscContact> contacts, std::span<SolverBody> bodies, const BounceRule& rule);
bool bounce(std::span<PointContact> contacts, std::span<SolverBody> bodies, const BounceRule& rule);

}  // namespace throng
