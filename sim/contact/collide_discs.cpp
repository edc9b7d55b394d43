// SPDX-License-Identifier: MIT
#include "sim/contact/collide_discs.h"

#include <algorithm>

namespace throng {

double collide_discs(SolverBody& a, SolverBody& b, const DiscTouch& touch, const Surface& surface) {
  const Vec& n = touch.normal;
  const Vec t = tangent(n);
  const Vec velocity = b.velocity - a.velocity;
  const double normal =
      std::max(0.0, -(1.0 + surface.restitution) * velocity.dot(n) / (a.inverse_mass + b.inverse_mass));
  Vec impulse = normal * n;
  if (surface.friction > 0.0) {
    const double slip = velocity.dot(t) - (a.spin * touch.radius_a + b.spin * touch.radius_b);
    const double limit = surface.friction * normal;
    const double rub =
        std::clamp(-effective_mass(a, b, touch.radius_a, touch.radius_b) * slip, -limit, limit);
    impulse += rub * t;
    a.spin -= a.inverse_inertia * touch.radius_a * rub;
    b.spin -= b.inverse_inertia * touch.radius_b * rub;
  }
  a.velocity -= a.inverse_mass * impulse;
  b.velocity += b.inverse_mass * impulse;
  return normal;
}

}  // namespace throng
