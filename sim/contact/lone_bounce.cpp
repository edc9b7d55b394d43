// SPDX-License-Identifier: MIT
#include "sim/contact/lone_bounce.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "sim/contact/arms.h"
#include "sim/contact/solve.h"

namespace throng {

namespace {

constexpr int kNewtons = 12;            // steps to when two meet: few are needed, more where they turn fast
constexpr double kNear = 1e-6;          // of the substep: from so near one step of Newton's is exact
constexpr double kAtOnce = 1e-6;        // of it: who meets so soon is struck at the same time
constexpr double kLeastOverlap = 1e-9;  // of the way in a substep, by which two are in each other
constexpr double kMostTurn = 0.1;       // rad, in the substep

/// m/s, what gravity adds within `t` (s).
Vec fall(const SolverBody& body, double t, const BounceRule& rule) {
  return body.is_dynamic() ? Vec(t / rule.h * rule.kick) : Vec(0.0, 0.0);
}

void fly(SolverBody& body, double t, const BounceRule& rule) {
  const Vec fallen = fall(body, t, rule);
  body.position += t * (body.velocity + 0.5 * fallen);
  body.velocity += fallen;
  body.turn += t * body.spin;
}

/// From the end of a substep to its beginning.
void go_back(SolverBody& body, const Velocities& before, const BounceRule& rule) {
  body.position -= rule.h * (body.velocity - 0.5 * fall(body, rule.h, rule));
  body.turn -= rule.h * body.spin;
  body.velocity = before.linear, body.spin = before.spin;
}

void prepare_now(std::span<DiscContact> contacts, BodyRows<const SolverBody> bodies, const BounceRule& rule) {
  prepare(contacts, bodies, rule.period, 0.0);
}
void prepare_now(std::span<PointContact> contacts, BodyRows<const SolverBody> bodies, const BounceRule&) {
  prepare(contacts, bodies);
}

bool strike(std::span<DiscContact> contacts, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  return bounce(contacts[0], bodies, rule);
}
bool strike(std::span<PointContact> contacts, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  return bounce(contacts, bodies, rule);
}

/// s, until the first of the contacts meets, by the velocities of now; infinity where none comes nearer.
template <class Contact>
double soonest(std::span<const Contact> contacts, const SolverBody& a, const SolverBody& b) {
  double time = std::numeric_limits<double>::infinity();
  for (const Contact& contact : contacts) {
    const double speed = arms(contact).normal_velocity(a, b);
    if (speed < 0.0) time = std::min(time, -contact.separation / speed);
  }
  return time;
}

/// Flies to where the two meet, by Newton's method, or through the substep. Returns when that is (s).
template <class Contact>
std::optional<double> fly_to_meeting(std::span<Contact> contacts, BodyRows<SolverBody> bodies,
                                     const BounceRule& rule) {
  SolverBody &a = bodies[contacts[0].a], &b = bodies[contacts[0].b];
  double time = 0.0, step = rule.h;
  for (int i = 0; i < kNewtons; ++i) {
    prepare_now(contacts, bodies, rule);
    if (std::abs(step) <= kNear * rule.h) return time;
    step = std::min(soonest<Contact>(contacts, a, b), rule.h - time);
    if (!(time + step >= 0.0)) return {};
    fly(a, step, rule), fly(b, step, rule);
    time += step;
  }
  return {};
}

/// Whether the two are in each other.
template <class Contact>
bool overlap(std::span<Contact> contacts, BodyRows<const SolverBody> bodies, const BounceRule& rule) {
  prepare_now(contacts, bodies, rule);
  const double way = rule.h * (bodies[contacts[0].b].velocity - bodies[contacts[0].a].velocity).norm();
  return std::ranges::any_of(
      contacts, [&](const Contact& contact) { return contact.separation < -kLeastOverlap * way; });
}

/// Whether one may turn so far in the substep that its corners get into the other and out again.
bool turns_far(const SolverBody& a, const SolverBody& b, const BounceRule& rule) {
  return std::max(std::abs(a.spin), std::abs(b.spin)) * rule.h > kMostTurn;
}

/// Lets the two bounce who have met.
template <class Contact>
bool bounce_now(std::span<Contact> contacts, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  BounceRule now = rule;
  now.kick.setZero();
  now.within = kAtOnce * rule.h;
  now.threshold = 0.0;
  return strike(contacts, bodies, now);
}

template <class Contact>
bool try_to_bounce(std::span<Contact> contacts, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  SolverBody &a = bodies[contacts[0].a], &b = bodies[contacts[0].b];
  for (Contact& contact : contacts) contact.struck_in_step -= contact.struck;
  const bool points = std::is_same_v<Contact, PointContact>;
  if (points && turns_far(a, b, rule)) return false;
  const std::optional<double> time = fly_to_meeting(contacts, bodies, rule);
  if (!time) return false;
  const double left = rule.h - *time;
  if (left > 0.0) {
    if (!bounce_now(contacts, bodies, rule) || (points && turns_far(a, b, rule))) return false;
    fly(a, left, rule), fly(b, left, rule);
  }
  return !overlap(contacts, bodies, rule);
}

template <class Contact>
void try_or_leave(std::span<Contact> contacts, const Velocities& before_a, const Velocities& before_b,
                  BodyRows<SolverBody> bodies, const BounceRule& rule, std::vector<Told>& told) {
  SolverBody &a = bodies[contacts[0].a], &b = bodies[contacts[0].b];
  const SolverBody end_a = a, end_b = b;
  told.clear();
  for (const Contact& contact : contacts) told.push_back({contact.struck_in_step, contact.struck_at});
  go_back(a, before_a, rule), go_back(b, before_b, rule);
  if (try_to_bounce(contacts, bodies, rule)) return;
  a = end_a, b = end_b;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    contacts[i].struck_in_step = told[i].struck, contacts[i].struck_at = told[i].at;
}

}  // namespace

void bounce_as_they_meet(std::span<DiscContact> contacts, const Velocities& a, const Velocities& b,
                         BodyRows<SolverBody> bodies, const BounceRule& rule, std::vector<Told>& told) {
  try_or_leave(contacts, a, b, bodies, rule, told);
}

void bounce_as_they_meet(std::span<PointContact> contacts, const Velocities& a, const Velocities& b,
                         BodyRows<SolverBody> bodies, const BounceRule& rule, std::vector<Told>& told) {
  try_or_leave(contacts, a, b, bodies, rule, told);
}

}  // namespace throng
