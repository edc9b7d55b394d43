// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/contact/bounce.h"
#include "sim/contact/contact.h"

namespace throng {

/// Of a body.
struct Velocities {
  Vec linear;   ///< m/s
  double spin;  ///< rad/s
};

/// What was told of a contact before: a buffer.
struct Told {
  double struck;  ///< N s
  Vec at;         ///< m
};

/// Strikes act as a substep begins, though the two meet later: sooner by up to twice the way there. Where
/// nothing else touched the two that is mended at the substep's end: they go back to its beginning, with the
/// velocities `a` and `b` that they had before the strike, fly to where they meet, turning as they do, bounce
/// there, and fly on: or to the end, where they don't meet before. Exact but for rounding where the parts
/// that meet are those of the contacts, which are of the same two bodies, and their normals stay. The bodies
/// are left as they are where they were in each other as the substep began, would meet twice, or what isn't
/// a disc turns far. O(contacts
/// squared), some ten times a strike.
void bounce_as_they_meet(std::span<DiscContact> contacts, const Velocities& a, const Velocities& b,
                         BodyRows<SolverBody> bodies, const BounceRule& rule, std::vector<Told>& told);
void bounce_as_they_meet(std::span<PointContact> contacts, const Velocities& a, const Velocities& b,
                         BodyRows<SolverBody> bodies, const BounceRule& rule, std::vector<Told>& told);

}  // namespace throng
