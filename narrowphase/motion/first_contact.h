// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/closest.h"
#include "narrowphase/motion/motion.h"

/// When do two moving shapes touch first? For whether a path is free, however long it is, see
/// `check_motion`.
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
  double t_lo, t_hi;  ///< s, see below; free: both the duration
  int evaluations;    ///< distances and depths taken
};

/// The first contact of two convex shapes from time 0 to `duration`: what a rigid body's step asks of a fast
/// body, one call a pair and step. Expects finite motions, lengths and speeds up to 1e150, shapes that are
/// points or together 1e-150 m in size or more, below which squares lose their digits, and a finite duration
/// >= 0.
///
/// A hit: the two overlap at t_hi, by more than rounding, in a bracket no wider than asked for. Only where
/// rounding alone takes longer, because the gap closes slowly or a motion's numbers are large, is it wider,
/// and as narrow as that lets. Shapes that touch or overlap at time 0, as `separation` says, hit there: both
/// are 0. Undecided: from t_lo to t_hi the gap is 0 within rounding (about 2e-15 of all lengths and ways),
/// and what comes after is not known; or the evaluations ran out at t_lo, and t_hi is the end. A point
/// without radius that goes through a segment without one is undecided: they never overlap.
///
/// Conservative advancement (Mirtich 1996) made second order: along the normal of the closest features, which
/// turns with the shape whose edge is closest, the gap over all vertices is at least a parabola, whose
/// bend is bounded for good; each step goes to its root, so that it is certain and yet Newton's. Discs that
/// turn about their centres: in closed form. From the ninth distance on each vertex has a bend of its own.
///
/// Swapping a and b swaps the answer, up to rounding. O(k (n + m)), k = 3 to 6 distances mostly, for grazing
/// paths three more with each digit of clearance; O(k (log n + log m)) above 32 vertices, the first eight
/// times. Allocates nothing.
FirstContact first_contact(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                           double duration, const ContactQuestion& question = {});

}  // namespace throng::narrowphase
