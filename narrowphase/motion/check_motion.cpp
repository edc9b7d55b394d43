// SPDX-License-Identifier: MIT
#include "narrowphase/motion/check_motion.h"

#include <algorithm>
#include <cmath>

namespace throng::narrowphase {

namespace {

double radius(const MovingSolid& solid) {
  return solid.shape->tree.nodes[0].far;
}

/// Pairs of rigid bodies for `bisect`.
class RigidPairs {
 public:
  RigidPairs(std::span<const MovingPair> pairs, std::size_t segments) : pairs_(pairs), segments_(segments) {}

  std::size_t size() const { return pairs_.size(); }
  std::size_t segments() const { return segments_; }
  std::uint32_t segment(std::uint32_t k) const { return pairs_[k].segment; }
  double duration(std::uint32_t k) const { return pairs_[k].duration; }
  double pace(std::uint32_t k) const {
    return gap_rate(pairs_[k].a.motion, pairs_[k].b.motion).of(radius(pairs_[k].a), radius(pairs_[k].b));
  }
  double resolution(std::uint32_t k) const { return narrowphase::resolution(pairs_[k]); }

  SafeTime safe_time(std::uint32_t k, double time, SafeTimeQuestion question) const {
    const auto& [a, b, duration, segment] = pairs_[k];
    question.pose_error = pose_rounding(a.motion, time, radius(a)) + pose_rounding(b.motion, time, radius(b));
    const GapRate rate = gap_rate(a.motion, b.motion);
    const RelativeMotion motion{a.motion.spin, b.motion.spin, b.motion.velocity - a.motion.velocity,
                                rate.shift};
    question.motion = &motion;
    return narrowphase::safe_time(*a.shape, pose_at(a.motion, time), *b.shape, pose_at(b.motion, time), rate,
                                  question);
  }

 private:
  std::span<const MovingPair> pairs_;
  std::size_t segments_;
};

std::size_t segments(std::span<const MovingPair> pairs) {
  std::size_t count = 0;
  for (const MovingPair& pair : pairs) count = std::max(count, std::size_t{1} + pair.segment);
  return count;
}

}  // namespace

double resolution(const MovingPair& pair) {
  const double a = radius(pair.a), b = radius(pair.b);
  const double size = a > 0.0 && b > 0.0 ? std::min(a, b) : std::max(a, b);
  const double coordinates =
      pose_rounding(pair.a.motion, pair.duration, a) + pose_rounding(pair.b.motion, pair.duration, b);
  return 0x1p-34 * size + 0x1p7 * coordinates;
}

PathAnswer check_motion(const PartsBvh& a, const Motion& motion_a, const PartsBvh& b, const Motion& motion_b,
                        double duration, const BisectOptions& options) {
  BisectScratch scratch;
  return check_motion(a, motion_a, b, motion_b, duration, options, scratch);
}

PathAnswer check_motion(const PartsBvh& a, const Motion& motion_a, const PartsBvh& b, const Motion& motion_b,
                        double duration, const BisectOptions& options, BisectScratch& scratch) {
  const MovingPair pair{{&a, motion_a}, {&b, motion_b}, duration};
  return check_motions({&pair, 1}, options, scratch);
}

PathAnswer check_motions(std::span<const MovingPair> pairs, const BisectOptions& options,
                         BisectScratch& scratch) {
  return bisect(RigidPairs(pairs, segments(pairs)), options, scratch);
}

PathAnswer check_motions(std::span<const MovingPair> pairs, const BisectOptions& options,
                         BisectScratch& scratch, std::span<PathAnswer> answers) {
  return bisect_all(RigidPairs(pairs, answers.size()), options, scratch, answers);
}

}  // namespace throng::narrowphase
