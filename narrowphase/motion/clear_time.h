// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

#include "narrowphase/convex.h"

/// How long two convex things in motion keep a gap between them, to second order.
namespace throng::narrowphase {

/// How b moves relative to a at an instant, and how that may change.
struct RelativeMotion {
  double spin_a, spin_b;      ///< rad/s, constant
  Vec velocity;               ///< m/s, of b's origin relative to a's, in the world
  double speed;               ///< m/s, which that never exceeds
  double acceleration = 0.0;  ///< m/s², at most; 0 where origins go straight
};

/// One of the two: its core, and how it stands and reaches.
struct Standing {
  std::span<const Vec> vertices;
  Pose pose;
  double far;  ///< m, at least the farthest vertex's distance from the origin
};

/// Two things that are apart along `normal` (unit, from a to b) by more than `margin`: their radii and all
/// that rounding may do, m.
struct OpenGap {
  Standing a, b;
  Vec normal;
  double margin;
};

struct ClearTime {
  double before, after;  ///< s
};
inline ClearTime longer(const ClearTime& x, const ClearTime& y) {
  return {std::max(x.before, y.before), std::max(x.after, y.after)};
}
inline ClearTime shorter(const ClearTime& x, const ClearTime& y) {
  return {std::min(x.before, y.before), std::min(x.after, y.after)};
}

/// For how long before and after the instant the gap along the normal surely stays open, the normal turning
/// with a or with b, whichever serves longer; at most `wanted`. Along such an axis one of the two doesn't
/// change, and each vertex of the other is at least h + h' t - M t² / 2 away, M = acceleration + |w| (2 speed
/// + |w| distance of the origins now) + (difference of spins)² its own distance from its origin, w the axis'
/// spin; what doesn't spin has its origin in each vertex. Near grazing, where h' is small, it lasts as
/// sqrt(h / M), where distance over rate would last as h. O(n + m); allocates nothing.
ClearTime clear_time(const OpenGap& gap, const RelativeMotion& motion, const ClearTime& wanted);

/// Two balls: `arm` goes from the thing's origin to the ball's centre, `offset` from a's centre to b's;
/// `margin` is the sum of the radii and all that rounding may do. m.
struct BallGap {
  Vec arm_a, arm_b, offset;
  double margin;
};

/// The same along the line of their centres, which stands still, to a bend of acceleration + spin_a^2 |arm_a|
/// + spin_b^2 |arm_b|. About 15 ns.
ClearTime clear_time(const BallGap& gap, const RelativeMotion& motion);

}  // namespace throng::narrowphase
