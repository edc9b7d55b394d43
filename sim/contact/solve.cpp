// SPDX-License-Identifier: MIT
#include "sim/contact/solve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace throng {

Softness softness(double hertz, double damping, double h) {
  const double omega = 2.0 * std::numbers::pi * hertz;
  const double a1 = 2.0 * damping + h * omega;
  const double a2 = h * omega * a1;
  const double a3 = 1.0 / (1.0 + a2);
  return {omega / a1, a2 * a3, a3};
}

namespace {

Vec tangent(const Vec& normal) {
  return {-normal.y(), normal.x()};
}

double cross(const Vec& a, const Vec& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// How the two kinds of contact reach their bodies: velocity of b against a at the contact, and an impulse
/// there. For discs about their centres a normal impulse turns nothing and a tangential one has the radius as
/// its arm.
struct DiscArms {
  const DiscContact& contact;
  const Vec t = tangent(contact.normal);

  double normal_velocity(const SolverBody& a, const SolverBody& b) const {
    return (b.velocity - a.velocity).dot(contact.normal);
  }
  double tangent_velocity(const SolverBody& a, const SolverBody& b) const {
    return (b.velocity - a.velocity).dot(t) - a.spin * contact.radius_a - b.spin * contact.radius_b;
  }
  void push(SolverBody& a, SolverBody& b, double impulse) const {
    a.velocity -= impulse * a.inverse_mass * contact.normal;
    b.velocity += impulse * b.inverse_mass * contact.normal;
  }
  void rub(SolverBody& a, SolverBody& b, double impulse) const {
    a.velocity -= impulse * a.inverse_mass * t;
    b.velocity += impulse * b.inverse_mass * t;
    a.spin -= impulse * a.inverse_inertia * contact.radius_a;
    b.spin -= impulse * b.inverse_inertia * contact.radius_b;
  }
};

struct PointArms {
  const PointContact& contact;
  const Vec t = tangent(contact.normal);

  Vec velocity(const SolverBody& a, const SolverBody& b) const {
    return b.velocity + b.spin * tangent(contact.arm_b) - a.velocity - a.spin * tangent(contact.arm_a);
  }
  double normal_velocity(const SolverBody& a, const SolverBody& b) const {
    return velocity(a, b).dot(contact.normal);
  }
  double tangent_velocity(const SolverBody& a, const SolverBody& b) const { return velocity(a, b).dot(t); }
  void apply(SolverBody& a, SolverBody& b, const Vec& impulse) const {
    a.velocity -= a.inverse_mass * impulse;
    a.spin -= a.inverse_inertia * cross(contact.arm_a, impulse);
    b.velocity += b.inverse_mass * impulse;
    b.spin += b.inverse_inertia * cross(contact.arm_b, impulse);
  }
  void push(SolverBody& a, SolverBody& b, double impulse) const { apply(a, b, impulse * contact.normal); }
  void rub(SolverBody& a, SolverBody& b, double impulse) const { apply(a, b, impulse * t); }
};

DiscArms arms(const DiscContact& contact) {
  return {contact};
}
PointArms arms(const PointContact& contact) {
  return {contact};
}

double separation(const ContactBase& c, const SolverBody& a, const SolverBody& b) {
  return c.offset + c.normal.dot(b.position - a.position);
}

/// Coulomb: the tangential impulse stays within friction times the normal one.
template <class Contact>
void rub(Contact& contact, SolverBody& a, SolverBody& b) {
  const auto at = arms(contact);
  const double limit = contact.friction * contact.normal_impulse;
  const double old = contact.tangent_impulse;
  if (limit == 0.0 && old == 0.0) return;
  const double wanted = old - contact.tangent_mass * at.tangent_velocity(a, b);
  contact.tangent_impulse = std::clamp(wanted, -limit, limit);
  at.rub(a, b, contact.tangent_impulse - old);
}

/// Drives the normal velocity towards at least -bias; impulses only push.
template <class Contact>
void press(Contact& contact, SolverBody& a, SolverBody& b, double bias, double mass_scale,
           double impulse_scale) {
  const auto at = arms(contact);
  const double old = contact.normal_impulse;
  const double wanted =
      old - contact.normal_mass * mass_scale * (at.normal_velocity(a, b) + bias) - impulse_scale * old;
  contact.normal_impulse = std::max(wanted, 0.0);
  at.push(a, b, contact.normal_impulse - old);
}

template <class Contact>
void push_apart_all(std::span<Contact> contacts, std::span<SolverBody> bodies,
                    const SolverSettings& settings) {
  const Softness soft = settings.softness;
  const double rate = 1.0 / settings.h;
  for (Contact& contact : contacts) {
    SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
    const double s = separation(contact, a, b);
    if (s > 0.0)
      press(contact, a, b, s * rate, 1.0, 0.0);
    else
      press(contact, a, b, std::max(s * soft.bias_rate, -settings.push_out), soft.mass_scale,
            soft.impulse_scale);
    if (settings.friction) rub(contact, a, b);
  }
}

template <class Contact>
void relax_all(std::span<Contact> contacts, std::span<SolverBody> bodies, const SolverSettings& settings) {
  const double rate = 1.0 / settings.h;
  for (Contact& contact : contacts) {
    SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
    const double s = separation(contact, a, b);
    if (s > 0.0 && contact.normal_impulse == 0.0)
      continue;  // what it may yet meet is the next substep's matter
    press(contact, a, b, std::max(s, 0.0) * rate, 1.0, 0.0);
    if (settings.friction) rub(contact, a, b);
  }
}

template <class Contact>
void warm_start_all(std::span<const Contact> contacts, std::span<SolverBody> bodies) {
  for (const Contact& contact : contacts) {
    if (contact.normal_impulse == 0.0) continue;
    SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
    arms(contact).push(a, b, contact.normal_impulse);
    if (contact.tangent_impulse != 0.0) arms(contact).rub(a, b, contact.tangent_impulse);
  }
}

/// The velocity that gravity adds to b against a, along the normal: nothing where both fall.
double relative_kick(const ContactBase& c, const SolverBody& a, const SolverBody& b, const Vec& kick) {
  const double falls_a = a.inverse_mass > 0.0 ? 1.0 : 0.0, falls_b = b.inverse_mass > 0.0 ? 1.0 : 0.0;
  return (falls_b - falls_a) * kick.dot(c.normal);
}

template <class Contact>
bool bounce_all(std::span<Contact> contacts, std::span<SolverBody> bodies, double h, double threshold,
                const Vec& kick) {
  bool bounced = false;
  for (Contact& contact : contacts) {
    if (contact.restitution == 0.0) continue;
    SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
    const auto at = arms(contact);
    const double speed = at.normal_velocity(a, b);
    if (!(speed < -threshold)) continue;
    const double fall = relative_kick(contact, a, b, kick);
    if (!(separation(contact, a, b) + h * (speed + fall) < 0.0)) continue;
    const double impulse = contact.normal_mass * -((1.0 + contact.restitution) * speed + fall);
    at.push(a, b, impulse);
    const double limit = contact.friction * impulse;
    if (limit > 0.0)
      at.rub(a, b, std::clamp(-contact.tangent_mass * at.tangent_velocity(a, b), -limit, limit));
    bounced = true;
  }
  return bounced;
}

/// The vector after a turn by a small angle: two terms of sine and cosine, exact to its cube.
Vec turned(const Vec& v, double angle) {
  return v + angle * tangent(v) - 0.5 * angle * angle * v;
}

/// a.x and a.y less whole periods, such that the result is the nearest image.
Vec nearest_image(Vec d, const Vec& period) {
  d.x() -= period.x() * std::floor(d.x() / period.x() + 0.5);
  d.y() -= period.y() * std::floor(d.y() / period.y() + 0.5);
  return d;
}

}  // namespace

void prepare(std::span<DiscContact> contacts, std::span<const SolverBody> bodies, const Vec* period) {
  for (DiscContact& contact : contacts) {
    const Vec between = bodies[contact.b].position - bodies[contact.a].position;
    const Vec nearest = period ? nearest_image(between, *period) : between;
    const double distance = std::sqrt(nearest.squaredNorm());
    contact.normal = distance > 0.0 ? Vec(nearest / distance) : Vec(1.0, 0.0);
    contact.offset = contact.normal.dot(nearest - between) - (contact.radius_a + contact.radius_b);
  }
}

void prepare(std::span<PointContact> contacts, std::span<const SolverBody> bodies) {
  for (PointContact& contact : contacts) {
    contact.arm_a = turned(contact.first_a, contact.turns_a * bodies[contact.a].turn);
    contact.arm_b = turned(contact.first_b, contact.turns_b * bodies[contact.b].turn);
    contact.offset = contact.gap + contact.normal.dot(contact.arm_b - contact.arm_a);
  }
}

void warm_start(std::span<const DiscContact> contacts, std::span<SolverBody> bodies) {
  warm_start_all(contacts, bodies);
}
void warm_start(std::span<const PointContact> contacts, std::span<SolverBody> bodies) {
  warm_start_all(contacts, bodies);
}

void push_apart(std::span<DiscContact> contacts, std::span<SolverBody> bodies,
                const SolverSettings& settings) {
  push_apart_all(contacts, bodies, settings);
}
void push_apart(std::span<PointContact> contacts, std::span<SolverBody> bodies,
                const SolverSettings& settings) {
  push_apart_all(contacts, bodies, settings);
}

void relax(std::span<DiscContact> contacts, std::span<SolverBody> bodies, const SolverSettings& settings) {
  relax_all(contacts, bodies, settings);
}
void relax(std::span<PointContact> contacts, std::span<SolverBody> bodies, const SolverSettings& settings) {
  relax_all(contacts, bodies, settings);
}

bool bounce(std::span<DiscContact> contacts, std::span<SolverBody> bodies, double h, double threshold,
            const Vec& kick) {
  return bounce_all(contacts, bodies, h, threshold, kick);
}
bool bounce(std::span<PointContact> contacts, std::span<SolverBody> bodies, double h, double threshold,
            const Vec& kick) {
  return bounce_all(contacts, bodies, h, threshold, kick);
}

}  // namespace throng
