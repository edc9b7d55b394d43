// SPDX-License-Identifier: MIT
#include "sim/contact/solve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/contact/arms.h"
#include "sim/contact/fast.h"
#include "sim/periodic.h"

namespace throng {

Softness softness(double hertz, double damping, double h) {
  const double omega = 2.0 * std::numbers::pi * hertz;
  const double a1 = 2.0 * damping + h * omega;
  const double a2 = h * omega * a1;
  const double a3 = 1.0 / (1.0 + a2);
  return {omega / a1, a2 * a3, a3};
}

namespace {

double separation(const DiscContact& c, const SolverBody& a, const SolverBody& b) {
  return c.offset + c.normal.dot(b.position - a.position);
}

/// How far an arm's end gets along the normal in a turn by one radian, to first order.
double rise(const Vec& arm, const PointContact& c) {
  return cross(arm, c.normal);
}

/// To first order in what the bodies have turned in the substep.
double separation(const PointContact& c, const SolverBody& a, const SolverBody& b) {
  const double way = c.normal.dot(b.position - a.position);
  return (c.offset + way) + (rise(c.arm_b, c) * b.turn - rise(c.arm_a, c) * a.turn);
}

/// What a sweep asks of a contact: a normal velocity of at least -bias, more or less softly.
struct Wish {
  double bias;     ///< m/s
  double nothing;  ///< m/s, see SolverSettings
  double mass_scale = 1.0, impulse_scale = 0.0;
};

/// The change of the normal impulse that grants the wish; impulses only push. Of the preload nothing is let
/// go. What rounding makes of two that arrive as the substep ends is none: else they would be stopped by
/// relax(), point after point, and not as what hits.
double press(ContactBase& contact, double velocity, const Wish& wish) {
  const double old = contact.normal_impulse;
  const double wanted = old - contact.normal_mass * wish.mass_scale * (velocity + wish.bias) -
                        wish.impulse_scale * std::max(old - contact.preload, 0.0);
  const double least = contact.normal_mass * (kNoChange * std::abs(velocity) + wish.nothing);
  contact.normal_impulse = wanted > least ? wanted : 0.0;
  return contact.normal_impulse - old;
}

/// The change of the tangential impulse that stops the slip. Coulomb: it stays within friction times the
/// normal one.
double rub(ContactBase& contact, double slip) {
  const double limit = contact.friction * contact.normal_impulse;
  const double old = contact.tangent_impulse;
  contact.tangent_impulse = std::clamp(old - contact.tangent_mass * slip, -limit, limit);
  return contact.tangent_impulse - old;
}

/// Both at once: pressing a disc doesn't change its slip.
void respond(DiscContact& contact, SolverBody& a, SolverBody& b, const Wish& wish, bool friction) {
  const DiscArms at = arms(contact);
  const double slip = friction ? at.tangent_velocity(a, b) : 0.0;
  const double normal = press(contact, at.normal_velocity(a, b), wish);
  at.apply(a, b, normal, friction ? rub(contact, slip) : 0.0);
}

void respond(PointContact& contact, SolverBody& a, SolverBody& b, const Wish& wish, bool friction) {
  const PointArms at = arms(contact);
  at.apply(a, b, press(contact, at.normal_velocity(a, b), wish), 0.0);
  if (friction) at.apply(a, b, 0.0, rub(contact, at.tangent_velocity(a, b)));
}

bool is_apart(const ContactBase& contact, double separation, const SolverSettings& settings) {
  return separation > (contact.preload > 0.0 ? settings.ajar : 0.0);
}

/// What push_apart asks at that separation. Where the speed is limited, the impulse that is let go is less by
/// as much: else nothing would bear more than what the limit alone holds, and be pressed through the other.
Wish wish_at(const ContactBase& contact, double separation, const SolverSettings& settings) {
  if (is_apart(contact, separation, settings)) return {separation * (1.0 / settings.h), settings.nothing()};
  const Softness& soft = settings.softness;
  const double deep = settings.push_out / soft.bias_rate;  // m, from where on
  const double limited = deep / std::max(-separation, deep);
  return {std::max(separation * soft.bias_rate, -settings.push_out), settings.nothing(), soft.mass_scale,
          soft.impulse_scale * limited};
}

template <class Contact, class F>
void for_each_in_turn(std::span<Contact> contacts, bool backward, F f) {
  for (std::size_t i = 0; i < contacts.size(); ++i) f(contacts[backward ? contacts.size() - 1 - i : i]);
}

template <class Contact>
void push_apart_all(std::span<Contact> contacts, BodyRows<SolverBody> bodies,
                    const SolverSettings& settings) {
  for_each_in_turn(contacts, settings.backward, [&](Contact& contact) {
    SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
    respond(contact, a, b, wish_at(contact, contact.separation, settings), settings.friction);
  });
}

template <class Contact>
void relax_all(std::span<Contact> contacts, BodyRows<SolverBody> bodies, const SolverSettings& settings) {
  const double rate = 1.0 / settings.h;
  for_each_in_turn(contacts, settings.backward, [&](Contact& contact) {
    if (contact.normal_impulse == 0.0)
      return;  // what may yet meet is the next substep's matter, and may bounce
    SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
    const double s = separation(contact, a, b);
    respond(contact, a, b, Wish{is_apart(contact, s, settings) ? s * rate : 0.0, settings.nothing()},
            settings.friction);
  });
}

template <class Contact>
void warm_start_all(std::span<const Contact> contacts, BodyRows<SolverBody> bodies) {
  for (const Contact& contact : contacts)
    if (contact.normal_impulse > 0.0)
      arms(contact).apply(bodies[contact.a], bodies[contact.b], contact.normal_impulse,
                          contact.tangent_impulse);
}

/// m²/s², of b against a.
double speed_squared(const ContactBase& contact, BodyRows<const SolverBody> bodies) {
  return (bodies[contact.b].velocity - bodies[contact.a].velocity).squaredNorm();
}

/// The way from a's centre to b's when they meet or are nearest within `ahead` (s); `between` (m) is what it
/// is now, and stays where they are slow, part or overlap.
Vec between_ahead(const DiscContact& contact, const Vec& between, const Vec& velocity, double ahead) {
  const double reach = contact.radius_a + contact.radius_b;
  const double slow = kAheadWay * std::min(contact.radius_a, contact.radius_b);
  const double excess = between.dot(between) - reach * reach, nearing = -between.dot(velocity);
  const double squared = velocity.dot(velocity);
  if (!(squared * (ahead * ahead) > slow * slow && excess > 0.0 && nearing > 0.0)) return between;
  const double root = std::sqrt(std::max(nearing * nearing - squared * excess, 0.0));
  const double time = root > 0.0 ? excess / (nearing + root) : nearing / squared;
  return between + std::min(time, ahead) * velocity;
}

}  // namespace

void prepare(std::span<DiscContact> contacts, BodyRows<const SolverBody> bodies, const Vec* period,
             double ahead) {
  for (DiscContact& contact : contacts) {
    const SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
    const Vec between = b.position - a.position;
    const Vec nearest = period ? nearest_image(between, *period) : between;
    const Vec then = ahead > 0.0 ? between_ahead(contact, nearest, b.velocity - a.velocity, ahead) : nearest;
    const double distance = std::sqrt(then.squaredNorm());
    contact.normal = distance > 0.0 ? Vec(then / distance) : Vec(1.0, 0.0);
    contact.offset = contact.normal.dot(nearest - between) - (contact.radius_a + contact.radius_b);
    contact.separation = separation(contact, bodies[contact.a], bodies[contact.b]);
    contact.struck = contact.rubbed = contact.rolled = 0.0;
  }
}

void prepare(std::span<PointContact> contacts, BodyRows<const SolverBody> bodies) {
  for (PointContact& contact : contacts) {
    const SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
    if (contact.turner.body != Turner::Body::none) contact.gap = contact.normal.dot(contact.turner.shift);
    contact.arm_a = Turn(a.turn)(contact.first_a) + contact.round_a * contact.normal;
    contact.arm_b = Turn(b.turn)(contact.first_b) - contact.round_b * contact.normal;
    if (std::max(std::abs(a.turn), std::abs(b.turn)) > kFarTurn) set_masses(contact, a, b);
    const double offset = contact.gap + contact.normal.dot(contact.arm_b - contact.arm_a);
    contact.separation = offset + contact.normal.dot(b.position - a.position);
    contact.offset = offset - (rise(contact.arm_b, contact) * b.turn - rise(contact.arm_a, contact) * a.turn);
    contact.struck = contact.rubbed = contact.rolled = 0.0;
  }
}

void warm_start(std::span<const DiscContact> contacts, BodyRows<SolverBody> bodies) {
  warm_start_all(contacts, bodies);
}
void warm_start(std::span<const PointContact> contacts, BodyRows<SolverBody> bodies) {
  warm_start_all(contacts, bodies);
}

void push_apart(std::span<DiscContact> contacts, BodyRows<SolverBody> bodies,
                const SolverSettings& settings) {
  push_apart_all(contacts, bodies, settings);
}
void push_apart(std::span<PointContact> contacts, BodyRows<SolverBody> bodies,
                const SolverSettings& settings) {
  push_apart_all(contacts, bodies, settings);
}

void relax(std::span<DiscContact> contacts, BodyRows<SolverBody> bodies, const SolverSettings& settings) {
  relax_all(contacts, bodies, settings);
}
void relax(std::span<PointContact> contacts, BodyRows<SolverBody> bodies, const SolverSettings& settings) {
  relax_all(contacts, bodies, settings);
}

void learn(std::span<DiscContact> contacts, BodyRows<const SolverBody> bodies, const Learning& learning) {
  for (DiscContact& contact : contacts)
    contact.preload = learning(contact.preload, contact.normal_impulse, contact.normal_mass,
                               speed_squared(contact, bodies));
}

void learn(std::span<PointContact> contacts, BodyRows<const SolverBody> bodies, const Learning& learning) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    PointContact &first = contacts[i], *second = nullptr;
    if (i + 1 < contacts.size() && contacts[i + 1].is_second) second = &contacts[++i];
    const double preload = second ? std::max(first.preload, second->preload) : first.preload;
    const double load = second ? 0.5 * (first.normal_impulse + second->normal_impulse) : first.normal_impulse;
    const double learnt = learning(preload, load, first.normal_mass, speed_squared(first, bodies));
    first.preload = std::min(learnt, first.normal_impulse);
    if (second) second->preload = std::min(learnt, second->normal_impulse);
  }
}

}  // namespace throng
