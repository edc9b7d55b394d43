// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/closest.h"
#include "narrowphase/motion/motion.h"

/// When do two moving shapes touch first? For whether a path is free, however long it is, see `safe_time`.
namespace throng::narrowphase {

struct ContactQuestion {
  double width = 1e-12;                 ///< of the shapes' size: how far the two may go from t_lo to t_hi
  int evaluations = 10000;              ///< most distances; above them the answer is `undecided`
  double from = 0.0;                    ///< s, up to where it is known that nothing touches
  ClosestFeatures* features = nullptr;  ///< as `track`: read and written, worth keeping from step to step
};

/// Nothing touches before t_lo: certain, rounding included.
struct FirstContact {
  Verdict verdict;
  double t_lo,
      t_hi;         ///< s. hit: they overlap at t_hi, by more than rounding. undecided: from t_lo to t_hi the
                    ///< gap is 0 within rounding, and what comes after is not known. free: both the duration
  int evaluations;  ///< distances and depths taken
};

/// The first contact of two convex shapes from time 0 to `duration`: what a rigid body's step asks of a fast
/// body, one call a pair and step. Expects finite motions and duration >= 0.
///
/// Shapes that touch or overlap at time 0, as `separation` says, hit there: t_lo = t_hi = 0. A gap that
/// closes is a hit in a bracket no wider than asked for, unless rounding is: where it closes so slowly, or
/// the size of a motion's numbers is such, that rounding alone takes longer, the bracket is as narrow as that
/// lets. A gap that comes as near to 0 as rounding (about 2e-15 of all lengths and ways) and doesn't surely
/// close is undecided. So is a point without radius that goes through a segment without one: they never
/// overlap.
///
/// Conservative advancement (Mirtich 1996) made second order: along the normal of the closest features, which
/// turns with the shape whose edge is closest, the gap over all vertices is at least a parabola, whose
/// bend is bounded for good; each step goes to its root, so that it is certain and yet Newton's. Discs that
/// turn about their centres: in closed form.
///
/// Swapping a and b swaps the answer, up to rounding. O(k (n + m)), k = 4 to 8 distances mostly, for grazing
/// paths as 1 / sqrt(clearance); O(k (log n + log m)) above 32 vertices. Allocates nothing.
FirstContact first_contact(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                           double duration, const ContactQuestion& question = {});

}  // namespace throng::narrowphase
