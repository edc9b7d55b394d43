// SPDX-License-Identifier: MIT
#include "tools/bench/motion_reference.h"

#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "narrowphase/exhaustive.h"

namespace throng::bench {

namespace {

using narrowphase::Convex;
using narrowphase::Motion;
using narrowphase::Vec;
using Digits50 = boost::multiprecision::cpp_dec_float_50;
using Long = long double;

template <class Real>
struct Pair2 {
  Real x, y;
};
template <class Real>
Pair2<Real> operator+(const Pair2<Real>& u, const Pair2<Real>& v) {
  return {u.x + v.x, u.y + v.y};
}
template <class Real>
Pair2<Real> operator-(const Pair2<Real>& u, const Pair2<Real>& v) {
  return {u.x - v.x, u.y - v.y};
}
template <class Real>
Real dot(const Pair2<Real>& u, const Pair2<Real>& v) {
  return u.x * v.x + u.y * v.y;
}
template <class Real>
Real cross(const Pair2<Real>& u, const Pair2<Real>& v) {
  return u.x * v.y - u.y * v.x;
}
template <class Real>
Pair2<Real> real(const Vec& v) {
  return {Real(v.x()), Real(v.y())};
}

/// A point in motion relative to another body's origin, in a frame that turns with that body.
template <class Real>
struct Track {
  Pair2<Real> at, rate;
};

/// The point `v` of the body with `motion` seen from `frame` at time t.
template <class Real>
Track<Real> track(const Motion& frame, const Motion& motion, const Vec& v, const Real& t) {
  using std::cos, std::sin;
  const auto turned = [](const Real& angle, const Pair2<Real>& u) {
    const Real c = cos(angle), s = sin(angle);
    return Pair2<Real>{c * u.x - s * u.y, s * u.x + c * u.y};
  };
  const Real spin(frame.spin), other_spin(motion.spin);
  const Real back = -(Real(frame.angle) + spin * t), angle = Real(motion.angle) + other_spin * t + back;
  const Pair2<Real> drift = real<Real>(motion.velocity) - real<Real>(frame.velocity);
  const Pair2<Real> between = real<Real>(motion.position) - real<Real>(frame.position);
  const Pair2<Real> y = turned(back, Pair2<Real>{between.x + t * drift.x, between.y + t * drift.y});
  const Pair2<Real> y_rate = turned(back, drift), w = turned(angle, real<Real>(v));
  const Real turn = other_spin - spin;
  return {y + w, {y_rate.x + spin * y.y - turn * w.y, y_rate.y - spin * y.x + turn * w.x}};
}

/// How the track's second derivative is bounded over the whole duration, and how far out it goes.
struct Bounds {
  Long speed, bend, reach;
};

Bounds bounds(const Motion& frame, const Motion& motion, const Vec& v, double duration) {
  const Long drift = (motion.velocity - frame.velocity).norm();
  const Long start = (motion.position - frame.position).norm(), out = v.norm();
  const Long far = start + drift * duration, spin = std::abs(frame.spin);
  const Long turn = std::abs(Long(motion.spin) - Long(frame.spin));
  return {drift + spin * far + turn * out, 2 * spin * drift + spin * spin * far + turn * turn * out,
          far + out};
}

/// What is zero at a touch, its derivative, and where along the edge it happens.
template <class Real>
struct Value {
  Real f, rate, along;
};

/// A vertex of one shape against the edge p q of the other, or against its vertex p alone.
struct Touch {
  Motion frame, motion;
  Vec vertex, p, q;
  double radius;
  bool of_edge;

  template <class Real>
  Value<Real> at(const Real& t) const {
    using std::sqrt;
    const Track<Real> v = track<Real>(frame, motion, vertex, t);
    const Pair2<Real> from = v.at - real<Real>(p);
    if (!of_edge) return {dot(from, from) - Real(radius) * Real(radius), 2 * dot(from, v.rate), Real(0)};
    const Pair2<Real> edge = real<Real>(q) - real<Real>(p);
    const Real length = sqrt(dot(edge, edge));
    // The outside of a counter-clockwise polygon lies on the right.
    return {-cross(edge, from) / length - Real(radius), -cross(edge, v.rate) / length,
            dot(edge, from) / length};
  }
  Long length() const { return (q - p).norm(); }
  /// Of f's second derivative.
  Long bend(const Bounds& b) const {
    const Long out = b.reach + p.norm();
    return of_edge ? b.bend : 2 * (b.speed * b.speed + out * b.bend);
  }
};

/// By Newton's method, which bisection takes over where it leaves the bracket.
template <class Real>
Real root(const Touch& touch, Real low, Real high) {
  const Real enough = 16 * std::numeric_limits<Real>::epsilon();
  const bool falls = touch.at(low).f > 0;
  Real t = (low + high) / 2;
  for (int i = 0; i < 200; ++i) {
    const Value<Real> value = touch.at(t);
    ((value.f > 0) == falls ? low : high) = t;
    Real next = value.rate != 0 ? Real(t - value.f / value.rate) : low;
    if (!(next > low && next < high)) next = (low + high) / 2;
    const Real step = next > t ? Real(next - t) : Real(t - next);
    t = next;
    if (step <= enough * (high + enough)) break;
  }
  return t;
}

struct Interval {
  Long from, to;
};

/// The first touch that is known, and the first time at which one may be or not.
struct Found {
  struct First {
    Touch touch;
    Interval bracket;  ///< of the root, in which f is monotone
    Long time;
  };
  std::optional<First> first;
  Long doubt = std::numeric_limits<Long>::infinity();
};

/// Whether the foot lies on the edge; in 50 digits where it is a near thing.
bool on_edge(const Touch& touch, const Interval& bracket, Long time, Long scale) {
  if (!touch.of_edge) return true;
  const Long along = touch.at(time).along, length = touch.length(), little = 1e-12L * scale;
  if (std::abs(along) > little && std::abs(along - length) > little) return along > 0 && along < length;
  const Digits50 exact = touch.at(root<Digits50>(touch, bracket.from, bracket.to)).along;
  const Digits50 edge = sqrt(dot(real<Digits50>(touch.q) - real<Digits50>(touch.p),
                                 real<Digits50>(touch.q) - real<Digits50>(touch.p)));
  return exact >= -1e-40 * scale && exact <= edge + 1e-40 * scale;
}

/// The touch's first time, if before what was found.
void improve(const Touch& touch, double duration, Found& found) {
  const Bounds b = bounds(touch.frame, touch.motion, touch.vertex, duration);
  const Long bend = touch.bend(b), length = touch.length();
  const Long scale = b.reach + touch.p.norm() + touch.q.norm() + touch.radius;
  const Long slack = 1e-17L * (touch.of_edge ? scale : scale * scale);
  std::vector<Interval> open{{0, found.first ? found.first->time : duration}};
  while (!open.empty()) {
    const Interval i = open.back();
    open.pop_back();
    const Long middle = (i.from + i.to) / 2, half = (i.to - i.from) / 2;
    const Value<Long> value = touch.at(middle);
    if (std::abs(value.f) > std::abs(value.rate) * half + bend * half * half / 2 + slack) continue;
    const Long slip = b.speed * half + 1e-17L * scale;
    if (touch.of_edge && (value.along + slip < 0 || value.along - slip > length)) continue;
    if (std::abs(value.rate) > bend * half + slack / (half + 1e-300L)) {
      if ((touch.at(i.from).f > 0) == (touch.at(i.to).f > 0)) continue;
      const Long time = root(touch, i.from, i.to);
      if (!on_edge(touch, i, time, scale)) continue;
      found.first = {touch, i, time};
      return;
    }
    if (half < 1e-16L * duration) return void(found.doubt = std::min(found.doubt, i.from));
    open.push_back({middle, i.to});
    open.push_back({i.from, middle});
  }
}

/// All vertices of b against all edges of a, and against its vertices where something is round.
void improve(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
             double duration, bool with_vertices, Found& found) {
  const double radius = a.radius + b.radius;
  const std::size_t n = a.vertices.size();
  for (const Vec& v : b.vertices)
    for (std::size_t i = 0; i < n; ++i) {
      const Vec &p = a.vertices[i], &q = a.vertices[(i + 1) % n];
      if (n > 1) improve(Touch{motion_a, motion_b, v, p, q, radius, true}, duration, found);
      if (with_vertices && radius > 0.0)
        improve(Touch{motion_a, motion_b, v, p, p, radius, false}, duration, found);
    }
}

}  // namespace

FirstTouch first_touch(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                       double duration) {
  if (narrowphase::exhaustive_separation(a, pose_at(motion_a, 0.0), b, pose_at(motion_b, 0.0)).distance <=
      0.0)
    return {0.0};
  Found found;
  improve(a, motion_a, b, motion_b, duration, true, found);
  improve(b, motion_b, a, motion_a, duration, false, found);
  FirstTouch touch;
  if (const auto& first = found.first)
    touch.time = static_cast<double>(root<Digits50>(first->touch, first->bracket.from, first->bracket.to));
  touch.grazes = found.doubt <= (found.first ? found.first->time : static_cast<Long>(duration));
  return touch;
}

}  // namespace throng::bench
