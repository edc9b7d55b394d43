// SPDX-License-Identifier: MIT
#include "narrowphase/motion/baselines/algebraic.h"

#include <cmath>

#include "narrowphase/distance.h"
#include "narrowphase/motion/baselines/interval_newton.h"
#include "narrowphase/motion/gap_parabola.h"
#include "narrowphase/motion/parabola.h"

namespace throng::narrowphase {

namespace {

/// One of the two shapes, and the other as seen from it.
struct View {
  const Convex &shape, &other;
  double spin, other_spin;
  Vec velocity;  ///< m/s, of the other
  bool from_a;
};

Vec turned_left(const Vec& v) {
  return {-v.y(), v.x()};
}

class AllFeatures {
 public:
  AllFeatures(const MovingConvexPair& pair, const TimeSpan& span, double duration,
              const ContactQuestion& question)
      : pair_(pair),
        span_(span),
        evaluations_(question.evaluations),
        best_{Verdict::free, duration, duration, 0} {
    const double moved = question.width * pair.size() / pair.rate;
    width_ = std::max(moved, 2.0 * pair.rounding / pair.rate);
    farthest_ = 0.0;
    for (const double time : {span.from, span.until})
      farthest_ = std::max(farthest_, direction(pair.offset_at(time) + pair.arms, {1.0, 0.0}).length);
  }

  FirstContact first_contact() {
    const View from_a{pair_.a, pair_.b, pair_.spin_a, pair_.spin_b, pair_.velocity, true};
    const View from_b{pair_.b, pair_.a, pair_.spin_b, pair_.spin_a, -pair_.velocity, false};
    for (const View& view : {from_a, from_b})
      for (std::size_t edge = 0; edge < view.shape.normals.size(); ++edge)
        for (const Vec& vertex : view.other.vertices) meet_edge(view, edge, vertex);
    if (pair_.radius > 0.0)
      for (const Vec& corner : pair_.a.vertices)
        for (const Vec& vertex : pair_.b.vertices) meet_corner(from_a, corner, vertex);
    return best_;
  }

 private:
  /// Where a vertex of the other is, from the shape's origin, and how fast it goes.
  struct Moving {
    Vec arm, place, velocity;
  };

  Moving moving(const View& view, const Vec& vertex, double time) const {
    const Pose other = view.from_a ? pair_.pose_b(time) : pair_.pose_a(time);
    const Vec arm = other.rotate(vertex);
    const Vec origin = view.from_a ? other.position : Vec(-pair_.offset_at(time));
    return {arm, origin + arm, view.velocity + view.other_spin * turned_left(arm)};
  }

  Pose pose(const View& view, double time) const {
    return view.from_a ? pair_.pose_a(time) : pair_.pose_b(time);
  }

  void meet_edge(const View& view, std::size_t edge, const Vec& vertex) {
    const Vec &tail = view.shape.vertices[edge], &normal = view.shape.normals[edge];
    const Vec& head = view.shape.vertices[next(edge, view.shape.vertices.size())];
    const auto height = [&](double time) {
      const Pose stands = pose(view, time);
      const Vec n = stands.rotate(normal), t = stands.rotate(tail);
      const Moving v = moving(view, vertex, time);
      ++best_.evaluations;
      return SlopedValue{dot(n, v.place - t) - pair_.radius,
                         rate_of_origins(n, view.spin, v.velocity, v.place)};
    };
    const double along = rate_along_edges(view);
    const auto over_edge = [&](double time, double half) {
      const Vec place = pose(view, time).unrotate(moving(view, vertex, time).place);
      const double slack = 4.0 * pair_.rounding + width_ * pair_.rate + half * along;
      return cross(normal, place - tail) >= -slack && cross(normal, place - head) <= slack;
    };
    const RootQuestion question{bend(pair_, view.spin, farthest_), pair_.rounding, width_, evaluations_};
    merge(first_root(rest(), question, height, over_edge));
  }

  /// How fast a vertex of the other goes as seen from the shape, at most.
  double rate_along_edges(const View& view) const {
    const double reach = view.from_a ? pair_.reach_b : pair_.reach_a;
    return pair_.speed + std::abs(view.other_spin) * reach + std::abs(view.spin) * (farthest_ + reach);
  }

  /// Half the difference of squares over the radius: a length, and about the gap.
  void meet_corner(const View& view, const Vec& corner, const Vec& vertex) {
    const double radius = pair_.radius, speed = pair_.rate;
    const double away = farthest_ + pair_.reach_a + pair_.reach_b;
    const double acceleration = bend(pair_, 0.0, farthest_);
    const auto gap = [&](double time) {
      const Vec arm = pose(view, time).rotate(corner);
      const Moving v = moving(view, vertex, time);
      const Vec between = v.place - arm, velocity = v.velocity - view.spin * turned_left(arm);
      ++best_.evaluations;
      const double length = direction(between, {1.0, 0.0}).length;
      return SlopedValue{0.5 * (length - radius) * (length / radius + 1.0), dot(between, velocity) / radius};
    };
    const RootQuestion question{(speed * speed + away * acceleration) / radius,
                                pair_.rounding * (1.0 + away / radius), width_, evaluations_};
    merge(first_root(rest(), question, gap, [](double, double) { return true; }));
  }

  TimeSpan rest() const { return {span_.from, std::min(span_.until, best_.t_hi)}; }

  void merge(const std::optional<Root>& root) {
    if (!root) return;
    const auto [from, until] = root->span;
    const bool doubt = best_.verdict == Verdict::undecided && root->certain && from <= best_.t_hi;
    const bool first = best_.verdict == Verdict::free || from < best_.t_lo;
    if (doubt || first) best_.verdict = root->certain ? Verdict::hit : Verdict::undecided, best_.t_hi = until;
    if (first) best_.t_lo = from;
  }

  const MovingConvexPair& pair_;
  TimeSpan span_;
  int evaluations_;
  FirstContact best_;
  double width_, farthest_;
};

}  // namespace

FirstContact algebraic_contact(const Convex& a, const Motion& motion_a, const Convex& b,
                               const Motion& motion_b, double duration, const ContactQuestion& question) {
  const MovingConvexPair pair(a, motion_a, b, motion_b, duration);
  const double from = question.from;
  if (separation(a, pair.pose_a(from), b, pair.pose_b(from)).distance <= 0.0)
    return {Verdict::hit, from, from, 0};
  TimeSpan span = near(pair, duration);
  span.from = std::max(span.from, from);
  if (span.until < span.from || !(pair.rate > 0.0)) return {Verdict::free, duration, duration, 0};
  return AllFeatures(pair, span, duration, question).first_contact();
}

}  // namespace throng::narrowphase
