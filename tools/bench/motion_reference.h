// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "narrowphase/motion/motion.h"

namespace throng::bench {

/// When two convex shapes in motion first touch, by nothing that throng's own answers are made of.
struct FirstTouch {
  std::optional<double> time;  ///< s, of 50 digits the first 17; none: free all the way
  bool grazes = false;  ///< a touch without crossing can't be told from a near miss: `time` is worthless
};

/// Over [0, duration]; 0 where they touch or overlap at the start. A vertex of one on an edge of the other,
/// or for rounded shapes as far from it or from a vertex as the radii say: each of these is a function of
/// time whose roots are isolated in long double, by halves from the left, with Taylor's remainder as the
/// bound, and then computed in 50 decimal digits; the least one whose foot lies on the edge counts. About 1
/// ms for octagons. Sines and cosines are those of the real numbers that the doubles stand for.
FirstTouch first_touch(const narrowphase::Convex& a, const narrowphase::Motion& motion_a,
                       const narrowphase::Convex& b, const narrowphase::Motion& motion_b, double duration);

}  // namespace throng::bench
