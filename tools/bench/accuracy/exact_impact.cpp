// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/exact_impact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/bench/accuracy/exact_throw.h"

namespace throng::bench {

namespace {

const Vec kNoGravity(0.0, 0.0);

Vec across(const Vec& v) {
  return {-v.y(), v.x()};
}

/// What two discs that touch do to each other in no time.
void strike(RigidDisc& a, RigidDisc& b, double restitution, double friction) {
  const Vec normal = (b.state.position - a.state.position).normalized(), tangent = across(normal);
  const double inverse = 1.0 / a.mass + 1.0 / b.mass;
  const Vec apart = a.state.velocity - b.state.velocity;
  const double slip = apart.dot(tangent) + a.state.spin * a.radius + b.state.spin * b.radius;
  const double push = (1.0 + restitution) * apart.dot(normal) / inverse;
  const double rub = std::clamp(slip / (3.0 * inverse), -friction * push, friction * push);
  const Vec impulse = push * normal + rub * tangent;
  a.state.velocity -= impulse / a.mass;
  b.state.velocity += impulse / b.mass;
  a.state.spin -= 2.0 * rub / (a.mass * a.radius);
  b.state.spin -= 2.0 * rub / (b.mass * b.radius);
}

}  // namespace

double meeting_time(const RigidDisc& a, const RigidDisc& b) {
  const Vec between = b.state.position - a.state.position, speed = b.state.velocity - a.state.velocity;
  const double touch = a.radius + b.radius, nearing = -between.dot(speed);
  const double excess = between.squaredNorm() - touch * touch;
  const double root = nearing * nearing - speed.squaredNorm() * excess;
  if (nearing <= 0.0 || root < 0.0) return std::numeric_limits<double>::infinity();
  return excess / (nearing + std::sqrt(root));
}

std::array<BodyState, 2> exact_impact(const std::array<RigidDisc, 2>& discs, double restitution,
                                      double friction, double t) {
  RigidDisc a = discs[0], b = discs[1];
  const double met = meeting_time(a, b), before = std::min(t, met);
  a.state = exact_throw(a.state, kNoGravity, before);
  b.state = exact_throw(b.state, kNoGravity, before);
  if (t <= met) return {a.state, b.state};
  strike(a, b, restitution, friction);
  return {exact_throw(a.state, kNoGravity, t - met), exact_throw(b.state, kNoGravity, t - met)};
}

}  // namespace throng::bench
