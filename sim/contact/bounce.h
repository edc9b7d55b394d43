// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/contact/body_rows.h"
#include "sim/contact/contact.h"

/// Bounces, before the sweeps of a substep: one pair after the other as in Guendelman, Bridson and Fedkiw
/// (2003), where bodies would meet in this substep. Sweep after sweep, until nothing bounces: bounce_queue.h.
namespace throng {

/// What of a substep bounces.
struct BounceRule {
  double h;             ///< s, the substep
  double within;        ///< s: what would meet so soon bounces
  double threshold;     ///< m/s: what meets more slowly rests
  double hit_speed;     ///< m/s: what hits is stopped from then on, although it doesn't bounce
  double follow_speed;  ///< m/s: the same of who was struck since the sweeps began
  Vec kick;             ///< m/s, what gravity adds to a dynamic body's velocity in the substep
  const Vec* period;    ///< and `ahead`, s: as in prepare()
  double ahead;
  double turning_h;  ///< s, as in turn_faces(): h, or -h where the substep is over but for what has arrived
};

/// Lets a contact bounce if the two would meet so soon. What doesn't bounce is left to the sweeps of the
/// contacts, but for what hits: it is stopped at the other's surface, whatever other surfaces of the scene
/// do. The impulses for that are those of all its contacts at once, as call follows call: projected
/// Gauss-Seidel, of which none pulls in sum. To be called after prepare(), for what bounces before gravity
/// acts: then the flight after a bounce with e = 1 mirrors the one before, and energy stays. Friction
/// is asked again, too, where others have made the two slip. Returns whether the two were struck, or what
/// struck them was corrected. O(1).
bool bounce(DiscContact& contact, BodyRows<SolverBody> bodies, const BounceRule& rule);

/// The same of all contacts of two bodies, one after the other, but as one impact where they have one normal.
/// O(contacts squared) where these meet.
bool bounce(std::span<PointContact> contacts, BodyRows<SolverBody> bodies, const BounceRule& rule);

}  // namespace throng
