// SPDX-License-Identifier: MIT
#include "narrowphase/motion/first_contact.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "narrowphase/motion/gap_parabola.h"
#include "narrowphase/motion/parabola.h"
#include "narrowphase/tracker.h"

namespace throng::narrowphase {

namespace {

/// A walk through time, which only goes on where nothing can touch.
class Advance {
 public:
  Advance(const MovingConvexPair& pair, const TimeSpan& span, double duration,
          const ContactQuestion& question)
      : pair_(pair), span_(span), duration_(duration), question_(question), time_(span.from) {
    width_ = question.width * pair.size();
    if (question.features) features_ = *question.features;
  }

  FirstContact first_contact() {
    const FirstContact found = search();
    if (question_.features) *question_.features = features_;
    return found;
  }

 private:
  FirstContact search() {
    look(time_);
    if (seen_.distance <= 0.0) return result(Verdict::hit, time_, time_);
    for (;;) {
      if (!(seen_.distance > 2.0 * pair_.rounding)) return settle_doubt();
      const TurningAxis along = axis();
      const GapParabola gap = gap_along(along);
      const double safe = time_ + std::max(gap.holds, straight_ahead());
      if (safe >= span_.until) return free();
      if (const double overlap = time_ + time_to_overlap(gap, along.bend);
          (overlap - safe) * pair_.rate <= width_ && overlaps_at(overlap))
        return result(Verdict::hit, safe, overlap);
      if (!(safe > time_) || evaluations_ >= question_.evaluations)
        return result(Verdict::undecided, time_, span_.until);
      look(time_ = safe);
    }
  }

  void look(double time) {
    placed_ = {pair_.pose_a(time), pair_.pose_b(time)};
    seen_ = track(pair_.a, placed_.a, pair_.b, placed_.b, features_);
    ++evaluations_;
  }

  /// The normal, turning with the shape whose edge it belongs to; between two corners it stands still.
  TurningAxis axis() const {
    const Convex& of_edge = features_.vertex_of_b ? pair_.a : pair_.b;
    const Pose& stands = features_.vertex_of_b ? placed_.a : placed_.b;
    if (features_.edge < of_edge.normals.size()) {
      const Vec normal = stands.rotate(of_edge.normals[features_.edge]);
      if (features_.vertex_of_b ? normal == seen_.normal : normal == -seen_.normal)
        return axis(features_.vertex_of_b ? pair_.spin_a : pair_.spin_b);
    }
    return axis(0.0);
  }

  TurningAxis axis(double spin) const { return {seen_.normal, spin, bend(pair_, spin, apart())}; }

  /// The two centres now. m.
  double apart() const { return direction(placed_.b.position + pair_.arms, {1.0, 0.0}).length; }

  /// Every bend by itself, which takes longer, where a path grazes: most are answered before.
  GapParabola gap_along(const TurningAxis& axis) const {
    constexpr int kUsual = 8;
    const double most = span_.until - time_;
    if (evaluations_ <= kUsual) return gap_parabola(pair_, placed_, axis, pair_.rounding, most);
    const double bend = bend_of_origins(axis.spin, pair_.speed, apart());
    return gap_parabola_by_vertex(pair_, placed_, {axis.normal, axis.spin, bend}, pair_.rounding, most);
  }

  /// How long the gap surely stays open along the normal as it stands.
  double straight_ahead() const {
    const double turning = pair_.rate - pair_.speed;
    const double closing = turning - dot(seen_.normal, pair_.velocity) + 0x1p-50 * pair_.rate;
    return closing > 0.0 ? (seen_.distance - 2.0 * pair_.rounding) / closing
                         : std::numeric_limits<double>::infinity();
  }

  /// When the nearest vertices are past each other by more than rounding, were they to go on and the bend
  /// against them.
  double time_to_overlap(const GapParabola& gap, double bend) const {
    if (!(gap.rate < 0.0)) return std::numeric_limits<double>::infinity();
    const double way = gap.gap + 4.0 * pair_.rounding, straight = way / -gap.rate;
    return (way + 0.5 * bend * straight * straight) / -gap.rate;
  }

  /// Whether the two surely overlap then: cheapest where the nearest vertex has gone straight in.
  bool overlaps_at(double time) {
    if (!(time <= span_.until)) return false;
    ++evaluations_;
    const PlacedPair then{pair_.pose_a(time), pair_.pose_b(time)};
    if (pair_.radius == 0.0 && nearest_vertex_is_inside(then)) return true;
    return track(pair_.a, then.a, pair_.b, then.b, features_).distance <= -pair_.rounding;
  }

  bool nearest_vertex_is_inside(const PlacedPair& then) const {
    const bool of_b = features_.vertex_of_b;
    const Convex &polygon = of_b ? pair_.a : pair_.b, &other = of_b ? pair_.b : pair_.a;
    const Pose &stands = of_b ? then.a : then.b, &other_stands = of_b ? then.b : then.a;
    if (features_.vertex >= other.vertices.size()) return false;
    const Vec point = relative(stands, other_stands) * other.vertices[features_.vertex];
    bool inside = !polygon.normals.empty();
    for (std::size_t i = 0; i < polygon.normals.size(); ++i)
      inside &= dot(polygon.normals[i], point - polygon.vertices[i]) <= -pair_.rounding;
    return inside;
  }

  /// The gap is 0 within rounding: goes on, twice as far each time, to where it is anything else.
  FirstContact settle_doubt() {
    const double start = time_;
    if (pair_.rate * span_.until == 0.0) return free();
    for (double ahead = std::max(0.5 * width_, 4.0 * pair_.rounding) / pair_.rate;; ahead *= 2.0) {
      const double time = std::min(span_.until, start + ahead);  // also where rounding has no bound
      look(time);
      if (seen_.distance <= -pair_.rounding) return result(Verdict::hit, start, time);
      if (seen_.distance > 4.0 * pair_.rounding || !(time < span_.until))
        return result(Verdict::undecided, start, time);
    }
  }

  FirstContact free() const { return result(Verdict::free, duration_, duration_); }

  FirstContact result(Verdict verdict, double t_lo, double t_hi) const {
    return {verdict, t_lo, t_hi, evaluations_};
  }

  const MovingConvexPair& pair_;
  TimeSpan span_;
  double duration_;
  const ContactQuestion& question_;
  double time_, width_;
  ClosestFeatures features_;
  PlacedPair placed_;
  Separation seen_;  ///< at time_, where a's origin is (0, 0)
  int evaluations_ = 0;
};

}  // namespace

FirstContact first_contact(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                           double duration, const ContactQuestion& question) {
  const MovingConvexPair pair(a, motion_a, b, motion_b, duration);
  assert(pair.size() == 0.0 || (pair.size() >= 1e-150 && pair.size() <= 1e150));
  TimeSpan span = near(pair, duration);
  span.from = std::max(span.from, question.from);
  if (span.until < span.from) return {Verdict::free, duration, duration, 0};
  return Advance(pair, span, duration, question).first_contact();
}

}  // namespace throng::narrowphase
