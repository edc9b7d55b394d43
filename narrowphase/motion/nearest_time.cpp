// SPDX-License-Identifier: MIT
#include "narrowphase/motion/nearest_time.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/relative.h"
#include "narrowphase/tracker.h"

namespace throng::narrowphase {

namespace {

constexpr int kMostLooks = 40;

/// What the two nearest points do at an instant.
struct Passing {
  double gap;    // m
  double rate;   // m/s, of the gap
  double ahead;  // s, until they would be nearest, were they to go straight on
};

class NearestTime {
 public:
  NearestTime(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
              double duration)
      : a_(a), b_(b), motion_a_(motion_a), motion_b_(motion_b), duration_(duration), to_(duration) {}

  double find() {
    const Passing first = look(0.0);
    if (parts(first, 0.0)) return 0.0;
    if (parts(look(duration_), duration_)) return duration_;
    double wanted = first.ahead;
    for (int looks = 2; looks < kMostLooks; ++looks) {
      const double length = to_ - from_, time = is_inside(wanted) ? wanted : from_ + 0.5 * length;
      if (!is_inside(time)) break;
      const Passing now = look(time);
      if (parts(now, time)) return time;
      (now.rate < 0.0 ? from_ : to_) = time;
      wanted = to_ - from_ <= 0.5 * length ? time + now.ahead : from_;
    }
    return from_;
  }

 private:
  bool is_inside(double time) const { return time > from_ && time < to_; }

  /// Whether the line between them, as they are now, is far from both, from the beginning to the end. That of
  /// shapes that turn is worth little but where they are nearest.
  bool parts(const Passing& now, double time) const {
    const double left = now.rate < 0.0 ? duration_ - time : time;
    const bool turns = motion_a_.spin != 0.0 || motion_b_.spin != 0.0;
    return std::abs(now.rate) * left <= (turns ? 0.02 : 0.5) * now.gap;
  }

  Passing look(double time) {
    const Pose pose_a = pose_at(motion_a_, time), pose_b = pose_at(motion_b_, time);
    const Separation s = track(a_, pose_a, b_, pose_b, features_);
    const Vec velocity = velocity_of(motion_b_, s.point_b - pose_b.position) -
                         velocity_of(motion_a_, s.point_a - pose_a.position);
    const double rate = dot(s.normal, velocity), squared = dot(velocity, velocity);
    const double between = s.distance + a_.radius + b_.radius;  // of what the radii are round
    return {s.distance, rate, squared > 0.0 ? -between * rate / squared : 0.0};
  }

  static Vec velocity_of(const Motion& motion, const Vec& arm) {
    return {motion.velocity.x() - motion.spin * arm.y(), motion.velocity.y() + motion.spin * arm.x()};
  }

  const Convex &a_, &b_;
  const Motion &motion_a_, &motion_b_;
  double duration_;
  double from_ = 0.0, to_;  // s: at the one they near each other, at the other they part
  ClosestFeatures features_;
};

}  // namespace

double nearest_time(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                    double duration) {
  return NearestTime(a, motion_a, b, motion_b, duration).find();
}

}  // namespace throng::narrowphase
