// SPDX-License-Identifier: MIT
#include "sim/contact/roll.h"

#include <algorithm>

#include "sim/contact/disc_blocks.h"
#include "sim/contact/face_blocks.h"

namespace throng {

namespace {

void apply(const RollContact& roll, double impulse, BodyRows<SolverBody> bodies) {
  SolverBody &a = bodies[roll.a], &b = bodies[roll.b];
  a.spin -= a.inverse_inertia * impulse;
  b.spin += b.inverse_inertia * impulse;
}

}  // namespace

double effective_radius(double a, double b) {
  return a > 0.0 && b > 0.0 ? a * b / (a + b) : std::max(a, b);
}

double rolling_radius(const narrowphase::Convex& shape) {
  return shape.vertices.size() == 1 ? shape.radius : 0.0;
}

void warm_start(std::span<const RollContact> rolls, BodyRows<SolverBody> bodies) {
  for (const RollContact& roll : rolls)
    if (roll.impulse != 0.0) apply(roll, roll.impulse, bodies);
}

template <class Blocks>
void resist(std::span<RollContact> rolls, const Blocks& contacts, BodyRows<SolverBody> bodies) {
  for (RollContact& roll : rolls) {
    const double limit = roll.lever * contacts.normal_impulse(roll.contact);
    const double old = roll.impulse;
    if (limit == 0.0 && old == 0.0) continue;  // as most of those that are only near do
    const double rolling = bodies[roll.b].spin - bodies[roll.a].spin;
    roll.impulse = std::clamp(old - roll.mass * rolling, -limit, limit);
    apply(roll, roll.impulse - old, bodies);
  }
}

template void resist(std::span<RollContact>, const DiscBlocks&, BodyRows<SolverBody>);
template void resist(std::span<RollContact>, const FaceBlocks&, BodyRows<SolverBody>);

}  // namespace throng
