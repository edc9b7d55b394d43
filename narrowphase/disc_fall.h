// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/half_plane.h"

/// When does a disc that falls freely touch what stands still? Exact but for rounding; two discs that both
/// fall fly straight past each other, see disc_flight.h.
namespace throng::narrowphase {

/// A point's flight under constant acceleration.
struct Fall {
  Vec position;  ///< m
  Vec velocity;  ///< m/s
  Vec pull;      ///< m/s²
};

/// When something `gap` (m) before a line crosses it: it nears it by `nearing` (m/s) and `pull` (m/s²). 0
/// where the gap is not above 0 and it nears; infinite where it never does. From behind the line, `gap` below
/// 0, it counts where it comes back after it has come out; who is behind it by no more than `rounding` (m)
/// and doesn't, as if he were on it.
double time_to_line(double gap, double nearing, double pull, double rounding);  ///< s

/// A disc, and all of the plane behind a border; s, infinite where it never does.
double fall_time(const Fall& centre, double radius, const HalfPlane& free);

/// A disc, and a shape in the world's frame, before `until` (s, finite): the first time at which it touches
/// and nears; else infinite. Expects that they overlap by no more than rounding. Vertices are roots of a
/// quartic. O(n).
double fall_time(const Fall& centre, double radius, const Convex& shape, double until);

}  // namespace throng::narrowphase
