// SPDX-License-Identifier: MIT
#include "tools/bench/motion_truth.h"

#include <algorithm>
#include <limits>

#include "narrowphase/exhaustive.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

/// From the body's origin.
double reach(const Convex& part) {
  double squared = 0.0;
  for (const Vec& v : part.vertices) squared = std::max(squared, v.squaredNorm());
  return std::sqrt(squared) + part.radius;
}

/// Whether the two parts are so far apart at both ends that they can't meet in between.
bool never_near(const Convex& a, const Convex& b, const MotionQuery& q, double until) {
  const double way = gap_rate(q.motion_a, q.motion_b).of(reach(a), reach(b)) * until;
  const auto apart = [&](double t) {
    return exhaustive_separation(a, pose_at(q.motion_a, t), b, pose_at(q.motion_b, t)).distance;
  };
  const double at_start = apart(0.0);
  return at_start > 0.0 && at_start + apart(until) > 1.000001 * way;
}

FirstTouch first_of_all(const MotionQuery& q) {
  FirstTouch first;
  double until = 1.0;
  for (const Convex& a : q.a->parts)
    for (const Convex& b : q.b->parts) {
      if (never_near(a, b, q, until)) continue;
      const FirstTouch touch = first_touch(a, q.motion_a, b, q.motion_b, until);
      first.grazes |= touch.grazes;
      if (touch.time) first.time = until = *touch.time;
    }
  return first;
}

}  // namespace

std::vector<std::optional<double>> truth(MotionCase& c) {
  std::vector<std::optional<double>> times;
  std::vector<MotionQuery> clear;
  for (const MotionQuery& q : c.queries) {
    const FirstTouch touch = c.past ? FirstTouch{} : first_of_all(q);
    if (touch.grazes) continue;
    clear.push_back(q);
    times.push_back(touch.time);
  }
  c.queries = std::move(clear);
  return times;
}

double exact_gap(const MotionQuery& q, double time) {
  double least = std::numeric_limits<double>::infinity();
  for (const Convex& a : q.a->parts)
    for (const Convex& b : q.b->parts)
      least = std::min(
          least, exhaustive_separation(a, pose_at(q.motion_a, time), b, pose_at(q.motion_b, time)).distance);
  return least;
}

}  // namespace throng::bench
