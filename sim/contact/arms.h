// SPDX-License-Identifier: MIT
#pragma once

#include "sim/contact/contact.h"

/// How contacts reach their bodies: the velocity of b against a at the contact (m/s), impulses there (N s),
/// on b, of which a feels the opposite, and where it is.
namespace throng {

/// Of two discs about their bodies' centres: a normal impulse turns nothing, and a tangential one has the
/// radius as its arm.
struct DiscArms {
  const DiscContact& contact;
  const Vec t = tangent(contact.normal);

  double normal_velocity(const SolverBody& a, const SolverBody& b) const {
    return (b.velocity - a.velocity).dot(contact.normal);
  }
  double tangent_velocity(const SolverBody& a, const SolverBody& b) const {
    return (b.velocity - a.velocity).dot(t) - (a.spin * contact.radius_a + b.spin * contact.radius_b);
  }
  void apply(SolverBody& a, SolverBody& b, double normal_impulse, double tangent_impulse) const {
    const Vec impulse = normal_impulse * contact.normal + tangent_impulse * t;
    a.velocity -= a.inverse_mass * impulse;
    a.spin -= a.inverse_inertia * contact.radius_a * tangent_impulse;
    b.velocity += b.inverse_mass * impulse;
    b.spin -= b.inverse_inertia * contact.radius_b * tangent_impulse;
  }
};

/// Of any two at a point.
struct PointArms {
  Vec arm_a, arm_b;  ///< m, from the bodies' centres
  Vec normal;        ///< unit, from a to b
  Vec t = tangent(normal);

  Vec velocity(const SolverBody& a, const SolverBody& b) const {
    return b.velocity + b.spin * tangent(arm_b) - a.velocity - a.spin * tangent(arm_a);
  }
  double normal_velocity(const SolverBody& a, const SolverBody& b) const {
    return velocity(a, b).dot(normal);
  }
  double tangent_velocity(const SolverBody& a, const SolverBody& b) const { return velocity(a, b).dot(t); }
  void apply(SolverBody& a, SolverBody& b, double normal_impulse, double tangent_impulse) const {
    const Vec impulse = normal_impulse * normal + tangent_impulse * t;
    a.velocity -= a.inverse_mass * impulse;
    a.spin -= a.inverse_inertia * cross(arm_a, impulse);
    b.velocity += b.inverse_mass * impulse;
    b.spin += b.inverse_inertia * cross(arm_b, impulse);
  }
};

inline DiscArms arms(const DiscContact& contact) {
  return {contact};
}
inline PointArms arms(const PointContact& contact) {
  return {contact.arm_a, contact.arm_b, contact.normal};
}

/// m, where discs are in touch, or come to be, as they stand: on a's rim.
inline Vec place(const DiscContact& contact, const SolverBody& a, const SolverBody&, double) {
  return a.position + contact.radius_a * contact.normal;
}

/// The same of a point, on the surface of who yields, who has turned for `time` (s) since arms were as they
/// are: a face that is driven may be felt elsewhere.
inline Vec place(const PointContact& contact, const SolverBody& a, const SolverBody& b, double time) {
  const bool of_a = a.is_dynamic();
  const SolverBody& body = of_a ? a : b;
  const Vec round = of_a ? Vec(contact.round_a * contact.normal) : Vec(-contact.round_b * contact.normal);
  const Vec turning = (of_a ? contact.arm_a : contact.arm_b) - round;
  return body.position + Turn(time * body.spin)(turning) + round;
}

}  // namespace throng
