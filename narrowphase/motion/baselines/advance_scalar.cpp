// SPDX-License-Identifier: MIT
#include "narrowphase/motion/baselines/advance_scalar.h"

#include <algorithm>

#include "narrowphase/motion/moving_convex_pair.h"
#include "narrowphase/tracker.h"

namespace throng::narrowphase {

FirstContact advance_scalar(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                            double duration, Closing closing, const ContactQuestion& question) {
  const MovingConvexPair pair(a, motion_a, b, motion_b, duration);
  const double enough = std::max(question.width * pair.size(), 2.0 * pair.rounding);
  ClosestFeatures features;
  double time = question.from;
  for (int looks = 1; looks <= question.evaluations; ++looks) {
    const Separation s = track(a, pair.pose_a(time), b, pair.pose_b(time), features);
    if (s.distance <= enough) return {Verdict::hit, time, time, looks};
    const double along = closing == Closing::scalar ? pair.speed : -dot(s.normal, pair.velocity);
    const double rate = pair.rate - pair.speed + along;
    if (!(rate * (duration - time) > s.distance - pair.rounding))
      return {Verdict::free, duration, duration, looks};
    time += (s.distance - pair.rounding) / rate;
  }
  return {Verdict::undecided, time, duration, question.evaluations};
}

}  // namespace throng::narrowphase
