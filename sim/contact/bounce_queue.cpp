// SPDX-License-Identifier: MIT
#include "sim/contact/bounce_queue.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/contact/solve.h"
#include "sim/periodic.h"

namespace throng {

namespace {

constexpr double kRounding = 1e-9;

/// m/s, of what may bounce, or hit.
double least_speed(bool bounces, const BounceRule& rule) {
  return (1.0 - kRounding) * (bounces ? rule.threshold : rule.hit_speed);
}

bool moves(const SolverBody& body) {
  return body.inverse_mass > 0.0;
}

/// The contacts at the front that are of the same two bodies.
std::size_t of_one_pair(std::span<const PointContact> contacts) {
  const auto other = [&](const PointContact& contact) {
    return contact.a != contacts[0].a || contact.b != contacts[0].b;
  };
  return static_cast<std::size_t>(std::ranges::find_if(contacts, other) - contacts.begin());
}

}  // namespace

void BounceQueue::list(std::span<const DiscContact> contacts) {
  for (std::uint32_t i = 0; i < contacts.size(); ++i) {
    const DiscContact& contact = contacts[i];
    const bool bounces = contact.restitution > 0.0;
    if (bounces || contact.hits)
      entries_.push_back({contact.a, contact.b, i, 1, contact.radius_a + contact.radius_b, bounces});
  }
}

void BounceQueue::list(std::span<const PointContact> contacts) {
  for (std::size_t first = 0, count; first < contacts.size(); first += count) {
    const std::span<const PointContact> pair = contacts.subspan(first, of_one_pair(contacts.subspan(first)));
    count = pair.size();
    Entry entry{pair[0].a, pair[0].b, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                -std::numeric_limits<double>::infinity()};
    Reach reach{.normal = pair[0].normal};
    bool hits = false;
    for (const PointContact& contact : pair) {
      entry.turns |= contact.turner.body != Turner::Body::none;
      if (contact.normal != pair[0].normal || entry.turns) reach.normal = Vec(0.0, 0.0);
      entry.touch = std::max(entry.touch, contact.round_a + contact.round_b - contact.gap -
                                              contact.normal.dot(contact.first_b - contact.first_a));
      reach.of_a = std::max(reach.of_a, contact.first_a.norm() + contact.round_a);
      reach.of_b = std::max(reach.of_b, contact.first_b.norm() + contact.round_b);
      entry.bounces |= contact.restitution > 0.0, hits |= contact.hits;
    }
    if (entry.bounces || hits) entries_.push_back(entry), reaches_.push_back(reach);
  }
}

void BounceQueue::start_step(const Contacts& contacts) {
  entries_.clear(), reaches_.clear(), joined_ = false;
  list(contacts.disc_bounces);
  discs_ = entries_.size();
  list(contacts.point_bounces);
  stands_.resize(contacts.point_bounces.size());
  prepared_.assign(entries_.size(), 0);
}

/// By how fast their centres are against each other, and how far apart. A little is left to rounding.
bool BounceQueue::discs_may_meet(std::size_t i, BodyRows<const SolverBody> bodies,
                                 const BounceRule& rule) const {
  const Entry& entry = entries_[i];
  const SolverBody &a = bodies[entry.a], &b = bodies[entry.b];
  const double speed = (b.velocity - a.velocity).norm();
  if (speed < least_speed(entry.bounces, rule)) return false;
  const Vec between = b.position - a.position,
            way = rule.period ? nearest_image(between, *rule.period) : between;
  const double near = entry.touch + rule.h * (speed + rule.kick.norm());
  return !(way.squaredNorm() > (1.0 + kRounding) * near * near);
}

/// Along their normal, which stays for the step, by no more than spins add to the speed there, and to the way
/// since the step began; by the speed alone where there are several normals.
bool BounceQueue::points_may_meet(std::size_t i, BodyRows<const SolverBody> bodies,
                                  const BounceRule& rule) const {
  const Entry& entry = entries_[i];
  const Reach& reach = reaches_[i - discs_];
  const SolverBody &a = bodies[entry.a], &b = bodies[entry.b];
  const Vec velocity = b.velocity - a.velocity, between = b.position - a.position;
  const bool one_normal = reach.normal != Vec(0.0, 0.0);
  const double spins = std::abs(a.spin) * reach.of_a + std::abs(b.spin) * reach.of_b;
  const double nears = spins + (one_normal ? -reach.normal.dot(velocity) : velocity.norm());
  if (nears < least_speed(entry.bounces, rule)) return false;
  if (!one_normal) return true;
  const double turned = std::abs(a.turn) * reach.of_a + std::abs(b.turn) * reach.of_b;
  const double apart = reach.normal.dot(between) - entry.touch - turned;
  return !(apart - kRounding * between.lpNorm<1>() > rule.h * (nears + rule.kick.norm()));
}

void BounceQueue::start(BodyRows<const SolverBody> bodies, const BounceRule& rule) {
  substep_ = ++phase_;
  struck_in_.resize(bodies.size());
  struck_.clear();
  waiting_.assign((entries_.size() + 63) / 64, 0);
  for (std::uint32_t i = 0; i < entries_.size(); ++i)
    if (i < discs_ ? discs_may_meet(i, bodies, rule) : points_may_meet(i, bodies, rule)) wait(i);
}

void BounceQueue::go_on() {
  ++phase_;
  std::ranges::fill(waiting_, 0);
  for (const std::uint32_t body : struck_) wait_for(body);
}

/// All of them: to look is as quick as to ask whether to, where most are near.
void BounceQueue::wait_for(std::uint32_t body) {
  for (std::uint32_t i = first_of_[body]; i < first_of_[body + 1]; ++i) wait(of_body_[i]);
}

/// Lists the entries of each body that moves.
void BounceQueue::join(BodyRows<const SolverBody> bodies) {
  first_of_.assign(bodies.size() + 1, 0);
  const auto for_each_end = [&](auto f) {
    for (std::uint32_t i = 0; i < entries_.size(); ++i)
      for (const std::uint32_t body : {entries_[i].a, entries_[i].b})
        if (moves(bodies[body])) f(body, i);
  };
  for_each_end([&](std::uint32_t body, std::uint32_t) { ++first_of_[body]; });
  std::uint32_t end = 0;
  for (std::uint32_t& first : first_of_) first = end += first;
  of_body_.resize(end);
  for_each_end([&](std::uint32_t body, std::uint32_t entry) { of_body_[--first_of_[body]] = entry; });
  joined_ = true;
}

/// What doesn't move isn't struck.
void BounceQueue::note_strike(std::uint32_t body, BodyRows<const SolverBody> bodies) {
  if (!moves(bodies[body])) return;
  if (struck_in_[body] < substep_) struck_.push_back(body);
  struck_in_[body] = phase_;
  wait_for(body);
}

bool BounceQueue::look_at(std::uint32_t i, Contacts& contacts, BodyRows<SolverBody> bodies,
                          const BounceRule& rule) {
  const Entry& entry = entries_[i];
  const bool is_new = std::exchange(prepared_[i], phase_) != phase_;
  if (i < discs_) {
    const std::span<DiscContact> one = std::span(contacts.disc_bounces).subspan(entry.first, 1);
    if (is_new) prepare(one, bodies, rule.period, rule.ahead);
    return bounce(one[0], bodies, rule);
  }
  const std::span<PointContact> pair = std::span(contacts.point_bounces).subspan(entry.first, entry.count);
  if (is_new) prepare(pair, bodies);
  if (entry.turns) {
    const std::span<FaceStand> stands = std::span(stands_).subspan(entry.first, entry.count);
    const SolverBody &a = bodies[entry.a], &b = bodies[entry.b];
    if (is_new) find_stands(pair, a, b, stands);
    turn_faces(pair, stands, a, b, rule.turning_h);
  }
  return bounce(pair, bodies, rule);
}

bool BounceQueue::sweep(Contacts& contacts, BodyRows<SolverBody> bodies, const BounceRule& rule) {
  BounceRule in_course = rule;
  in_course.hit_speed = rule.follow_speed;
  for (std::size_t word = 0; word < waiting_.size(); ++word) {
    std::uint64_t ahead = ~std::uint64_t{0};
    while (const std::uint64_t left = waiting_[word] & ahead) {
      const std::uint64_t bit = left & -left;
      ahead = ~(bit | (bit - 1));
      waiting_[word] &= ~bit;
      const std::uint32_t i =
          static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(bit));
      const auto [a, b] = std::pair(entries_[i].a, entries_[i].b);
      if (!look_at(i, contacts, bodies, was_struck(a) || was_struck(b) ? in_course : rule)) continue;
      if (!joined_) join(bodies);
      note_strike(a, bodies), note_strike(b, bodies);
    }
  }
  return std::ranges::any_of(waiting_, [](std::uint64_t word) { return word != 0; });
}

}  // namespace throng
