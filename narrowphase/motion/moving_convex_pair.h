// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/motion/motion.h"
#include "narrowphase/relative.h"

/// Two convex shapes in motion, seen from the origin of the first: a million metres from the world's origin
/// cost no digit. A shape that spins has its centre in its origin, one that doesn't in its middle: what
/// stands far from its own origin, as walls do, is judged by its size.
namespace throng::narrowphase {

/// From one time to another, seconds or whatever rates are per. Empty where until < from.
struct TimeSpan {
  double from, until;
};

struct MovingConvexPair {
  const Convex& a;
  const Convex& b;
  double angle_a, angle_b;  ///< rad, at time 0
  double spin_a, spin_b;    ///< rad/s
  Vec offset;               ///< m, from a's origin to b's at time 0
  Vec velocity;             ///< m/s, of b's origin relative to a's
  Vec arms;                 ///< m, to be added to an offset: from a's centre to b's
  double reach_a, reach_b;  ///< m, how far the cores go from their centres
  double radius;            ///< m, of both together
  double speed;             ///< m/s, of the centres
  double rate;              ///< m/s, that the distance changes by at most
  double rounding;          ///< m, above all errors of a distance or a gap at any time up to the last

  /// Until `duration`, finite and never negative; lengths and speeds up to 1e150, see `direction`. O(n + m).
  MovingConvexPair(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                   double duration);

  double size() const { return reach_a + reach_b + radius; }  ///< m
  Vec offset_at(double time) const { return offset + time * velocity; }
  Pose pose_a(double time) const { return pose({0.0, 0.0}, angle_a + time * spin_a); }
  Pose pose_b(double time) const { return pose(offset_at(time), angle_b + time * spin_b); }
};

/// When the two come near enough to each other to touch, however they turn: one span of the times from 0 to
/// `duration`, too long by about what rounding makes uncertain. In closed form; of two discs that turn about
/// their centres it is when they touch. All of it where numbers overflow or are none.
TimeSpan near(const MovingConvexPair& pair, double duration);

}  // namespace throng::narrowphase
