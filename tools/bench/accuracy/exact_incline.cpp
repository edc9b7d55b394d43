// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/exact_incline.h"

#include <cmath>
#include <limits>

namespace throng::bench {

namespace {

/// Under constant accelerations along the slope (m/s²) and of the spin (rad/s²).
BodyState accelerated(BodyState body, double along, double turning, double t) {
  body.position.x() += t * body.velocity.x() + 0.5 * t * t * along;
  body.angle += t * body.spin + 0.5 * t * t * turning;
  body.velocity.x() += t * along;
  body.spin += t * turning;
  return body;
}

double sign(double value) {
  return value > 0.0 ? 1.0 : value < 0.0 ? -1.0 : 0.0;
}

/// When `value` that changes at `rate` is 0; never where it doesn't get there.
double zero_of(double value, double rate) {
  return value * rate < 0.0 ? -value / rate : std::numeric_limits<double>::infinity();
}

}  // namespace

BodyState exact_incline(const BodyState& start, const Vec& gravity, double friction, double radius,
                        double t) {
  const double pull = gravity.x(), grip = friction * -gravity.y();
  const double slip = start.velocity.x() + radius * start.spin;
  if (slip == 0.0 && std::abs(pull) <= 3.0 * grip)
    return accelerated(start, 2.0 / 3.0 * pull, -2.0 / 3.0 * pull / radius, t);
  const double held = grip * (slip != 0.0 ? sign(slip) : sign(pull));
  const double ends = zero_of(slip, pull - 3.0 * held);
  if (t <= ends) return accelerated(start, pull - held, -2.0 * held / radius, t);
  BodyState caught = accelerated(start, pull - held, -2.0 * held / radius, ends);
  caught.spin = -caught.velocity.x() / radius;
  return exact_incline(caught, gravity, friction, radius, t - ends);
}

BodyState exact_slide(const BodyState& start, const Vec& gravity, double friction, double t) {
  const double pull = gravity.x(), grip = friction * -gravity.y(), speed = start.velocity.x();
  if (speed == 0.0 && std::abs(pull) <= grip) return start;
  const double held = grip * (speed != 0.0 ? sign(speed) : sign(pull));
  const double ends = zero_of(speed, pull - held);
  if (t <= ends) return accelerated(start, pull - held, 0.0, t);
  BodyState stopped = accelerated(start, pull - held, 0.0, ends);
  stopped.velocity.x() = 0.0;
  return exact_slide(stopped, gravity, friction, t - ends);
}

}  // namespace throng::bench
