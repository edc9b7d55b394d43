// SPDX-License-Identifier: MIT
#include "sim/contact/bounce.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/contact/arms.h"
#include "sim/contact/corner_impact.h"
#include "sim/contact/flat_impact.h"

namespace throng {

namespace {

constexpr double kSameNormal = 1.0 - 1e-12;  // cosine of the angle between normals up to which they are one

constexpr double kAtItsEnd = 1e-9;  // of the time within which two meet: what rounding may make of its end

constexpr double kLeastTakenBack = 1e-4;  // of an impulse: less is left
constexpr double kLeastRubbed = 0.1;      // of what Coulomb's law lets friction be: less is left

/// The velocity that gravity adds to b against a, along the normal: nothing where both fall.
double relative_kick(const ContactBase& c, const SolverBody& a, const SolverBody& b, const Vec& kick) {
  const double falls_a = a.is_dynamic() ? 1.0 : 0.0, falls_b = b.is_dynamic() ? 1.0 : 0.0;
  return (falls_b - falls_a) * kick.dot(c.normal);
}

/// With the arms of this substep: those of the step's beginning would cost energy.
double normal_mass(const PointContact& contact, const SolverBody& a, const SolverBody& b) {
  return effective_mass(a, b, contact.arm_a, contact.arm_b, contact.normal);
}
double normal_mass(const DiscContact& contact, const SolverBody&, const SolverBody&) {
  return contact.normal_mass;
}

double tangent_mass(const PointContact& contact, const SolverBody& a, const SolverBody& b) {
  return effective_mass(a, b, contact.arm_a, contact.arm_b, tangent(contact.normal));
}
double tangent_mass(const DiscContact& contact, const SolverBody&, const SolverBody&) {
  return contact.tangent_mass;
}

/// What gravity adds to the square of the speed at which two meet who are `s` (m) apart (m²/s²).
double gained(double s, double fall, double h) {
  return -2.0 * s * fall / h;
}

/// The speed with which two part that meet at `speed` (m/s, below 0) while `s` (m) apart, after `fall` (m/s),
/// what gravity does between them in the substep. As if they went on to the surface, bounced there, and came
/// back to where they are: energy stays that of their parabolas. Not above 0 where they wouldn't get back:
/// they arrive at the surface.
double parting_speed(double restitution, double speed, double s, double fall, double h) {
  if (restitution == 1.0) return -speed;
  const double more = gained(s, fall, h);
  const double after = restitution * restitution * (speed * speed + more) - more;
  return after > 0.0 ? std::sqrt(after) : 0.0;
}

/// The velocity at which what hits without a bounce arrives at the other's surface (m/s).
double arrival(const ContactBase& contact, double fall, double h) {
  return -std::max(contact.separation, 0.0) / h - fall;
}

/// Whether the two get to each other so soon, or together by rounding, after `fall`.
bool meet(const ContactBase& contact, double speed, double fall, const BounceRule& rule) {
  return contact.separation + rule.within * (speed + fall) < -kAtItsEnd * rule.within * speed;
}

/// The velocity that a bounce adds along the normal (m/s); 0 where the two don't meet so soon. What
/// doesn't bounce but hits arrives at the other's surface; who hits one that falls as he does, but may be
/// held by others, also as one that doesn't fall.
template <class Contact>
double rebound(Contact& contact, const SolverBody& a, const SolverBody& b, const BounceRule& rule) {
  const bool bounces = contact.restitution > 0.0;
  if (!bounces && !contact.hits) return 0.0;
  const double speed = arms(contact).normal_velocity(a, b);
  if (!(speed < -(bounces ? 0.0 : rule.hit_speed))) return 0.0;
  double fall = relative_kick(contact, a, b, rule.kick);
  const double s = contact.separation;
  if (bounces && speed * speed + gained(s, fall, rule.h) < rule.threshold * rule.threshold) return 0.0;
  if (!meet(contact, speed, fall, rule)) {
    if (bounces || !a.is_dynamic() || !b.is_dynamic()) return 0.0;
    fall = -std::abs(rule.kick.dot(contact.normal));
    if (!meet(contact, speed, fall, rule)) return 0.0;
  }
  contact.fall = fall;
  const double parts = bounces ? parting_speed(contact.restitution, speed, s, fall, rule.h) : 0.0;
  return (parts > 0.0 ? parts : arrival(contact, fall, rule.h)) - speed;
}

/// What all strikes of an impact add, of which one adds `added` (m/s): what hits without a bounce is first
/// slowed until it arrives, and then stopped.
double whole(const PointContact& contact, const SolverBody& a, const SolverBody& b, double added) {
  return contact.restitution > 0.0 ? added : std::max(added, -arms(contact).normal_velocity(a, b));
}

/// Adds what holds back how the two roll against each other, a torque's impulse (N m s).
void turn(ContactBase& contact, SolverBody& a, SolverBody& b, double impulse) {
  a.spin -= a.inverse_inertia * impulse;
  b.spin += b.inverse_inertia * impulse;
  contact.rolled += impulse;
}

/// Notes an impact's impulses, and holds the two spins together, as far as the normal one lets it.
template <class Contact>
void note(Contact& contact, SolverBody& a, SolverBody& b, double normal, double across) {
  contact.struck += normal, contact.struck_in_step += normal, contact.rubbed += across;
  if (contact.lever > 0.0) {
    const double limit = contact.lever * normal;
    turn(contact, a, b,
         std::clamp((a.spin - b.spin) / (a.inverse_inertia + b.inverse_inertia), -limit, limit));
  }
  contact.slip = arms(contact).tangent_velocity(a, b);
}

/// Notes where the two meet, who are about to be struck and may still be apart.
template <class Contact>
void note_place(Contact& contact, SolverBody a, SolverBody b, const BounceRule& rule) {
  const double nears = -arms(contact).normal_velocity(a, b), way = std::max(contact.separation, 0.0);
  const double time = nears > 0.0 ? std::min(way / nears, rule.within) : 0.0;
  a.position += time * a.velocity, b.position += time * b.velocity;
  contact.struck_at = place(contact, a, b, time);
}

/// Adds `added` (m/s) to the normal velocity. However short an impact is, what friction and rolling
/// resistance do stays within what the normal impulse allows: both laws hold at each instant of it. Pressing
/// a disc doesn't change its slip, nor rubbing it how it nears the other.
void strike_at(DiscContact& contact, SolverBody& a, SolverBody& b, double added) {
  const double normal = contact.normal_mass * added, limit = contact.friction * normal;
  arms(contact).apply(a, b, normal, 0.0);
  double across = 0.0;
  if (limit > 0.0) {
    across = std::clamp(-contact.tangent_mass * arms(contact).tangent_velocity(a, b), -limit, limit);
    arms(contact).apply(a, b, 0.0, across);
  }
  note(contact, a, b, normal, across);
}
void strike_at(PointContact& contact, SolverBody& a, SolverBody& b, double added) {
  const PointArms at = arms(contact);
  const auto [normal, across] = corner_impact(at, contact.friction, a, b, at.normal_velocity(a, b) + added);
  at.apply(a, b, normal, across);
  note(contact, a, b, normal, across);
}

/// What stops at several surfaces at once is stopped by all of them: one after the other each would take what
/// another had to, and throw it back. So of an impulse that didn't bounce the normal part is taken back as
/// far as others, since then, have made the two part, and the slip is rubbed by which they have made it more,
/// or turned it round. False where both are so little that they are left.
template <class Contact>
bool correct(Contact& contact, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  if (contact.restitution > 0.0 || !(contact.struck > 0.0)) return false;
  SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
  const auto at = arms(contact);
  const double parting = at.normal_velocity(a, b) - arrival(contact, contact.fall, rule.h);
  double back = parting > 0.0 ? std::min(normal_mass(contact, a, b) * parting, contact.struck) : 0.0;
  if (!(back > kLeastTakenBack * contact.struck)) back = 0.0;
  if (back > 0.0) at.apply(a, b, -back, 0.0);
  const double slip = at.tangent_velocity(a, b);
  const double more = slip - std::clamp(slip, std::min(contact.slip, 0.0), std::max(contact.slip, 0.0));
  if (back == 0.0 && more == 0.0) return false;
  const double limit = contact.friction * (contact.struck - back);
  const double rubbed = std::clamp(contact.rubbed - tangent_mass(contact, a, b) * more, -limit, limit);
  const double across = rubbed - contact.rubbed;
  if (back == 0.0 && !(std::abs(across) > kLeastRubbed * limit)) return false;
  contact.struck -= back, contact.struck_in_step -= back;
  at.apply(a, b, 0.0, across);
  contact.rubbed = rubbed;
  const double most = contact.lever * contact.struck;
  if (std::abs(contact.rolled) > most)
    turn(contact, a, b, std::clamp(contact.rolled, -most, most) - contact.rolled);
  contact.slip = at.tangent_velocity(a, b);
  return true;
}

template <class Contact>
bool bounce_one(Contact& contact, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
  const double added = rebound(contact, a, b, rule);
  if (!(added > 0.0)) return correct(contact, bodies, rule);
  note_place(contact, a, b, rule);
  strike_at(contact, a, b, added);
  return true;
}

/// Two points at which two bodies meet at once, on one line: one after the other would set a box that lands
/// flat spinning. False where that isn't one impact.
bool bounce_both(PointContact& i, PointContact& j, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  SolverBody &a = bodies[i.a], &b = bodies[i.b];
  const AtPoints added{rebound(i, a, b, rule), rebound(j, a, b, rule)};
  const auto impact = flat_impact(i, j, a, b, added, {whole(i, a, b, added.i), whole(j, a, b, added.j)});
  if (!impact) return false;
  if (impact->normal_i > 0.0) note_place(i, a, b, rule);
  if (impact->normal_j > 0.0) note_place(j, a, b, rule);
  apply(*impact, i, j, a, b);
  note(i, a, b, impact->normal_i, impact->across_i), note(j, a, b, impact->normal_j, impact->across_j);
  i.slip = arms(i).tangent_velocity(a, b);  // what holds back rolling at j may have turned them
  return true;
}

/// Of the contacts of two bodies those farthest apart, in their order, of all that meet along the normal of
/// that one: between them velocities are those between theirs.
std::pair<std::size_t, std::size_t> outermost(std::span<PointContact> contacts, std::size_t one,
                                              BodyRows<const SolverBody> bodies, const BounceRule& rule) {
  std::size_t low = one, high = one;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    PointContact& contact = contacts[i];
    if (!(contact.normal.dot(contacts[one].normal) > kSameNormal)) continue;
    if (!(rebound(contact, bodies[contact.a], bodies[contact.b], rule) > 0.0)) continue;
    const double lever = cross(contact.arm_a, contact.normal);
    if (lever < cross(contacts[low].arm_a, contact.normal)) low = i;
    if (lever > cross(contacts[high].arm_a, contact.normal)) high = i;
  }
  return std::minmax(low, high);
}

/// Which of two points at which bodies near each other meets first.
PointContact& sooner(PointContact& i, PointContact& j, BodyRows<const SolverBody> bodies) {
  const auto time = [&](const PointContact& contact) {
    return -contact.separation / arms(contact).normal_velocity(bodies[contact.a], bodies[contact.b]);
  };
  return time(j) < time(i) ? j : i;
}

}  // namespace

bool bounce(DiscContact& contact, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  return bounce_one(contact, bodies, rule);
}

bool bounce(std::span<PointContact> contacts, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  bool bounced = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!(rebound(contacts[i], bodies[contacts[i].a], bodies[contacts[i].b], rule) > 0.0)) {
      bounced |= correct(contacts[i], bodies, rule);
      continue;
    }
    const auto [low, high] = outermost(contacts, i, bodies, rule);
    if (low == high || !bounce_both(contacts[low], contacts[high], bodies, rule))
      bounce_one(sooner(contacts[low], contacts[high], bodies), bodies, rule);
    bounced = true;
  }
  return bounced;
}

}  // namespace throng
