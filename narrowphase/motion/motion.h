// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/convex.h"

/// A rigid body that moves, and by how much its movement can change a distance.
namespace throng::narrowphase {

/// The local origin goes straight, the body turns about it: both at a constant rate. Time may be seconds, or
/// the fraction of a path's segment; rates are then those per segment.
struct Motion {
  Vec position{0.0, 0.0};  ///< m, of the local origin at time 0
  double angle = 0.0;      ///< rad, at time 0
  Vec velocity{0.0, 0.0};  ///< m/s
  double spin = 0.0;       ///< rad/s
};

/// Where the body stands. About 15 ns.
Pose pose_at(const Motion& motion, double time);

/// How far a point that lies no farther than `radius` (m) from the local origin may be, through rounding,
/// from where the motion brings it: the pose's, and that of times next to `time`. m.
double pose_rounding(const Motion& motion, double time, double radius);

/// How fast the distance of two things can change at most, whatever their direction: where it is at least d,
/// it stays above 0 for d / of(...). The same in the plane and in space. For rigid bodies see `gap_rate`.
struct GapRate {
  double shift;           ///< m/s, of the two origins relative to each other
  double turn_a, turn_b;  ///< rad/s, never negative

  /// For all that is no farther from the body's origin than radius_a, radius_b (m). m/s.
  double of(double radius_a, double radius_b) const { return shift + turn_a * radius_a + turn_b * radius_b; }
};

/// For each point of each moving body: |velocity of b - velocity of a| + |spin| radius (Schwarzer, Saha and
/// Latombe 2005). In time t nothing moves by more than t times that, along any path of constant rates.
GapRate gap_rate(const Motion& a, const Motion& b);

/// What is known of a motion.
enum class Verdict { free, hit, undecided };

}  // namespace throng::narrowphase
