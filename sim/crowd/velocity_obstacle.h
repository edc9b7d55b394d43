// SPDX-License-Identifier: MIT
#pragma once

#include "sim/crowd/region.h"

namespace throng {

/// The nearest point of a velocity obstacle's border, and the way out of it there.
struct Escape {
  Vec point{0.0, 0.0};   ///< m/s
  Vec normal{1.0, 0.0};  ///< of length 1
};

/// The velocity obstacle of a line from `a` to `b` (m, seen from the agent) that is to be kept `radius` away
/// from: all velocities with which the agent meets it within `horizon` (s). Returns the point of its border
/// that is nearest to `v`; of a few equally near ones that of the front comes first, then that of the left
/// leg. With a == b it is that of a disc. Expects that the agent isn't within `radius` of the line. O(1).
///
/// Fiorini and Shiller, "Motion planning in dynamic environments using velocity obstacles" (IJRR 1998),
/// truncated as by van den Berg, Guy, Lin and Manocha, "Reciprocal n-body collision avoidance" (2011).
Escape escape(const Vec& a, const Vec& b, double radius, double horizon, const Vec& v);

}  // namespace throng
