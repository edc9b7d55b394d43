// SPDX-License-Identifier: MIT
#include "narrowphase/motion/check_motion.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// From its origin. m.
template <class Shape>
double far(const MovingSolid<Shape>& solid) {
  return solid.shape->tree.nodes[0].far;
}

/// What a solid turns about, or the middle of one that only goes straight.
struct Centre {
  Vec at;        ///< m, at time 0
  double reach;  ///< m, from there
};

template <class Shape>
Centre centre(const MovingSolid<Shape>& solid) {
  if (solid.motion.spin != 0.0) return {solid.motion.position, far(solid)};
  const auto& all = solid.shape->tree.nodes[0].volume;
  return {pose_at(solid.motion, 0.0) * Vec(all.centre), radius(all)};
}

/// When the two centres come nearest to each other; in the middle, where that is always within their reach,
/// as in a scene, or isn't known.
template <class Shape>
double nearest_pass(const SolidPair<Shape>& pair) {
  const Centre a = centre(pair.a), b = centre(pair.b);
  const Vec start = b.at - a.at, velocity = pair.b.motion.velocity - pair.a.motion.velocity;
  const Vec end = start + pair.duration * velocity;
  const Direction course = direction(velocity, {1.0, 0.0});
  const double time = -dot(start, course.unit) / course.length;
  if (!std::isfinite(time) || std::max(start.norm(), end.norm()) <= a.reach + b.reach)
    return 0.5 * pair.duration;
  return std::min(std::max(0.0, time), pair.duration);  // never -0
}

/// Pairs of rigid bodies for `bisect`.
template <class Shape>
class RigidPairs {
 public:
  RigidPairs(std::span<const SolidPair<Shape>> pairs, std::size_t segments)
      : pairs_(pairs), segments_(segments) {}

  std::size_t size() const { return pairs_.size(); }
  std::size_t segments() const { return segments_; }
  std::uint32_t segment(std::uint32_t k) const { return pairs_[k].segment; }
  double duration(std::uint32_t k) const { return pairs_[k].duration; }
  double likely(std::uint32_t k) const { return nearest_pass(pairs_[k]); }
  double pace(std::uint32_t k) const {
    return gap_rate(pairs_[k].a.motion, pairs_[k].b.motion).of(far(pairs_[k].a), far(pairs_[k].b));
  }
  double resolution(std::uint32_t k) const { return narrowphase::resolution(pairs_[k]); }

  SafeTime safe_time(std::uint32_t k, double time, SafeTimeQuestion question) const {
    const auto& [a, b, duration, segment] = pairs_[k];
    question.pose_error = pose_rounding(a.motion, time, far(a)) + pose_rounding(b.motion, time, far(b));
    const GapRate rate = gap_rate(a.motion, b.motion);
    const RelativeMotion motion{a.motion.spin, b.motion.spin, b.motion.velocity - a.motion.velocity,
                                rate.shift};
    question.motion = &motion;
    return narrowphase::safe_time(*a.shape, pose_at(a.motion, time), *b.shape, pose_at(b.motion, time), rate,
                                  question);
  }

 private:
  std::span<const SolidPair<Shape>> pairs_;
  std::size_t segments_;
};

template <class Shape>
std::size_t segments(std::span<const SolidPair<Shape>> pairs) {
  std::size_t count = 0;
  for (const SolidPair<Shape>& pair : pairs) count = std::max(count, std::size_t{1} + pair.segment);
  return count;
}

}  // namespace

template <class Shape>
double resolution(const SolidPair<Shape>& pair) {
  const double a = far(pair.a), b = far(pair.b);
  const double size = a > 0.0 && b > 0.0 ? std::min(a, b) : std::max(a, b);
  const double coordinates =
      pose_rounding(pair.a.motion, pair.duration, a) + pose_rounding(pair.b.motion, pair.duration, b);
  return 0x1p-34 * size + 0x1p7 * coordinates;
}

template <class Shape>
PathAnswer check_motion(const Shape& a, const Motion& motion_a, const Shape& b, const Motion& motion_b,
                        double duration, const BisectOptions& options) {
  BisectScratch scratch;
  return check_motion(a, motion_a, b, motion_b, duration, options, scratch);
}

template <class Shape>
PathAnswer check_motion(const Shape& a, const Motion& motion_a, const Shape& b, const Motion& motion_b,
                        double duration, const BisectOptions& options, BisectScratch& scratch) {
  const SolidPair<Shape> pair{{&a, motion_a}, {&b, motion_b}, duration};
  return check_motions(std::span(&pair, 1), options, scratch);
}

template <class Shape>
PathAnswer check_motions(std::span<const SolidPair<Shape>> pairs, const BisectOptions& options,
                         BisectScratch& scratch) {
  return bisect(RigidPairs<Shape>(pairs, segments(pairs)), options, scratch);
}

template <class Shape>
PathAnswer check_motions(std::span<const SolidPair<Shape>> pairs, const BisectOptions& options,
                         BisectScratch& scratch, std::span<PathAnswer> answers) {
  return bisect_all(RigidPairs<Shape>(pairs, answers.size()), options, scratch, answers);
}

#define THRONG_CHECK_MOTION(SHAPE)                                                                           \
  template double resolution(const SolidPair<SHAPE>&);                                                       \
  template PathAnswer check_motion(const SHAPE&, const Motion&, const SHAPE&, const Motion&, double,         \
                                   const BisectOptions&);                                                    \
  template PathAnswer check_motion(const SHAPE&, const Motion&, const SHAPE&, const Motion&, double,         \
                                   const BisectOptions&, BisectScratch&);                                    \
  template PathAnswer check_motions(std::span<const SolidPair<SHAPE>>, const BisectOptions&,                 \
                                    BisectScratch&);                                                         \
  template PathAnswer check_motions(std::span<const SolidPair<SHAPE>>, const BisectOptions&, BisectScratch&, \
                                    std::span<PathAnswer>);
THRONG_CHECK_MOTION(PartsBvh)
THRONG_CHECK_MOTION(Outline<Ball<2>>)
THRONG_CHECK_MOTION(Outline<Box<2>>)
THRONG_CHECK_MOTION(Outline<OrientedBox<2>>)
THRONG_CHECK_MOTION(Outline<BoxAndBall<2>>)
#undef THRONG_CHECK_MOTION

}  // namespace throng::narrowphase
