// SPDX-License-Identifier: MIT
#pragma once

#include "sim/contact/arms.h"

namespace throng {

/// An impact at one point: impulses on b (N s), along the normal and along it turned left.
struct CornerImpact {
  double normal, across;
};

/// The impact at those arms after which the two part at that speed (m/s), or, where that is 0 or below, near
/// each other still so fast and no faster. Friction acts all the while: it slows the slip by Coulomb's law,
/// holds it once it has stopped, or drives it back, and so changes what the normal impulse does. `parting`
/// over the speed of meeting is the restitution: that of energy, which is that of speeds as long as the slip
/// keeps its direction, and gives none where it is at most 1. Expects that the two near each other faster
/// than that. O(1).
///
/// Routh's method for impacts in the plane ("Dynamics of a System of Rigid Bodies", 1905; Wang and Mason, J.
/// Applied Mechanics 59, 635, 1992) with the restitution of Stronge (Proc. R. Soc. A 431, 169, 1990).
CornerImpact corner_impact(const PointArms& at, double friction, const SolverBody& a, const SolverBody& b,
                           double parting);

}  // namespace throng
