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

constexpr std::uint32_t kAcross = std::uint32_t{1} << 31;  // of an entry: joins parts

constexpr std::size_t kMany = 128;  // entries are worth handing over to other threads

/// m/s, of what may bounce, as gravity makes it faster on the way, which is as long as it gets in a substep,
/// or of what hits.
double least_speed(bool bounces, const BounceRule& rule) {
  const double kick = rule.kick.norm(), rests = rule.threshold;
  return (1.0 - kRounding) *
         (bounces ? std::sqrt(std::max(rests * rests - kick * kick, 0.0)) - kick : rule.hit_speed);
}

/// The contacts at the front that are of the same two bodies.
std::size_t of_one_pair(std::span<const PointContact> contacts) {
  const auto other = [&](const PointContact& contact) {
    return contact.a != contacts[0].a || contact.b != contacts[0].b;
  };
  return static_cast<std::size_t>(std::ranges::find_if(contacts, other) - contacts.begin());
}

}  // namespace

void BounceQueue::Group::mark() {
  const std::size_t words = (entries.size() + 63) / 64;
  acting.assign(words, 0), hitting.assign(words, 0);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::uint64_t acts = entries[i].bounces || entries[i].hits, hits = entries[i].hits;
    acting[i / 64] |= acts << i % 64, hitting[i / 64] |= hits << i % 64;
  }
}

std::size_t BounceQueue::count_waiting(const Group& group) const {
  std::size_t n = 0;
  for (std::size_t word = 0; word < group.waiting.size(); ++word)
    n += static_cast<std::size_t>(std::popcount(group.waiting[word] & asked(group)[word]));
  return n;
}

void BounceQueue::list(std::span<const DiscContact> contacts) {
  for (std::uint32_t i = 0; i < contacts.size(); ++i) {
    const DiscContact& contact = contacts[i];
    groups_[parts_->group(contact.a, contact.b)].entries.push_back({contact.a, contact.b, i, 1,
                                                                    contact.radius_a + contact.radius_b,
                                                                    contact.restitution > 0.0, contact.hits});
  }
}

void BounceQueue::list(std::span<const PointContact> contacts) {
  for (std::size_t first = 0, count; first < contacts.size(); first += count) {
    const std::span<const PointContact> pair = contacts.subspan(first, of_one_pair(contacts.subspan(first)));
    count = pair.size();
    Entry entry{pair[0].a, pair[0].b, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                -std::numeric_limits<double>::infinity()};
    Reach reach{.normal = pair[0].normal};
    for (const PointContact& contact : pair) {
      entry.turns |= contact.turner.body != Turner::Body::none;
      if (contact.normal != pair[0].normal || entry.turns) reach.normal = Vec(0.0, 0.0);
      entry.touch = std::max(entry.touch, contact.round_a + contact.round_b - contact.gap -
                                              contact.normal.dot(contact.first_b - contact.first_a));
      reach.of_a = std::max(reach.of_a, contact.first_a.norm() + contact.round_a);
      reach.of_b = std::max(reach.of_b, contact.first_b.norm() + contact.round_b);
      entry.bounces |= contact.restitution > 0.0, entry.hits |= contact.hits;
    }
    Group& group = groups_[parts_->group(entry.a, entry.b)];
    group.entries.push_back(entry), group.reaches.push_back(reach);
  }
}

void BounceQueue::start_step(const Contacts& contacts, const Parts& parts) {
  parts_ = &parts, joined_ = false;
  groups_.resize(parts.groups());
  for (Group& group : groups_)
    group.entries.clear(), group.reaches.clear(), group.bounces.clear(), group.struck.clear();
  list(contacts.disc_bounces);
  for (Group& group : groups_) group.discs = group.entries.size();
  list(contacts.point_bounces);
  for (Group& group : groups_) group.prepared.assign(group.entries.size(), 0), group.mark();
  stands_.resize(contacts.point_bounces.size());
}

/// By how fast their centres are against each other, and how far apart. A little is left to rounding.
inline bool BounceQueue::discs_may_meet(const Entry& entry, BodyRows<const SolverBody> bodies,
                                        const BounceRule& rule) {
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
bool BounceQueue::points_may_meet(const Entry& entry, const Reach& reach, BodyRows<const SolverBody> bodies,
                                  const BounceRule& rule) {
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

bool BounceQueue::may_meet(const Group& group, std::uint32_t i, BodyRows<const SolverBody> bodies,
                           const BounceRule& rule) {
  const Entry& entry = group.entries[i];
  return i < group.discs ? discs_may_meet(entry, bodies, rule)
                         : points_may_meet(entry, group.reaches[i - group.discs], bodies, rule);
}

/// Calls f(group) for the first `n` groups, one after the other or by several threads.
template <class F>
void BounceQueue::for_groups(std::size_t n, bool shared, Workers& workers, F f) {
  auto of_number = [&](std::size_t i) { f(groups_[i]); };
  if (shared) return workers.for_few(n, of_number);
  for (std::size_t i = 0; i < n; ++i) of_number(i);
}

void BounceQueue::start(BodyRows<const SolverBody> bodies, const BounceRule& rule, Workers& workers) {
  substep_ = ++phase_, stopping_ = false;
  strikes_.resize(bodies.size());
  std::size_t entries = 0;
  for (const Group& group : groups_) entries += group.entries.size();
  for_groups(groups_.size(), entries >= kMany, workers, [&](Group& group) {
    group.struck.clear(), group.bounces.clear();
    group.waiting.assign((group.entries.size() + 63) / 64, 0);
    for (std::uint32_t i = 0; i < group.entries.size(); ++i)
      if (may_meet(group, i, bodies, rule)) group.wait(i);
  });
}

void BounceQueue::go_on() {
  ++phase_, stopping_ = true;
  for (Group& group : groups_) std::ranges::fill(group.waiting, 0);
  for (const Group& group : groups_)
    for (const std::uint32_t body : group.struck)
      if (wait_within_part(body)) wait_across(body);
}

/// All of them: to look is as quick as to ask whether to, where most are near. Returns whether the body has
/// contacts that join parts, too.
bool BounceQueue::wait_within_part(std::uint32_t body) {
  Group& its = groups_[parts_->group(body)];
  bool across = false;
  for (std::uint32_t i = first_of_[body]; i < first_of_[body + 1]; ++i)
    if (of_body_[i] & kAcross)
      across = true;
    else
      its.wait(of_body_[i]);
  return across;
}

void BounceQueue::wait_across(std::uint32_t body) {
  for (std::uint32_t i = first_of_[body]; i < first_of_[body + 1]; ++i)
    if (of_body_[i] & kAcross) groups_.back().wait(of_body_[i] & ~kAcross);
}

/// Lists the entries of each body that moves.
void BounceQueue::join(BodyRows<const SolverBody> bodies) {
  first_of_.assign(bodies.size() + 1, 0);
  const auto for_each_end = [&](auto f) {
    for (const Group& group : groups_)
      for (std::uint32_t i = 0; i < group.entries.size(); ++i)
        for (const std::uint32_t body : {group.entries[i].a, group.entries[i].b})
          if (bodies[body].is_dynamic()) f(body, joins_parts(group) ? i | kAcross : i);
  };
  for_each_end([&](std::uint32_t body, std::uint32_t) { ++first_of_[body]; });
  std::uint32_t end = 0;
  for (std::uint32_t& first : first_of_) first = end += first;
  of_body_.resize(end);
  for_each_end([&](std::uint32_t body, std::uint32_t entry) { of_body_[--first_of_[body]] = entry; });
  joined_ = true;
}

/// Whether what is known of where two touch is true where they meet, too, and nobody else has struck them. Of
/// faces of what moves it isn't: they turn and slide.
inline bool BounceQueue::is_lone_bounce(const Group& group, std::uint32_t i,
                                        BodyRows<const SolverBody> bodies) const {
  const Entry& entry = group.entries[i];
  const auto was_struck = [&](std::uint32_t row) { return strikes_[bodies.slot(row)].phase >= substep_; };
  if (!entry.bounces || was_struck(entry.a) || was_struck(entry.b)) return false;
  if (i < group.discs) return true;
  return !entry.turns && !(bodies[entry.a].is_dynamic() && bodies[entry.b].is_dynamic());
}

/// What doesn't move isn't struck. Contacts that join parts come to wait at once if it was by one of them,
/// else when all parts have been swept. A few may be listed here: then one thread sweeps all.
void BounceQueue::note_strike(Group& group, std::uint32_t body, bool bounces,
                              BodyRows<const SolverBody> bodies) {
  if (!bodies[body].is_dynamic()) return;
  if (!joined_) join(bodies);
  Strikes& its = strikes_[bodies.slot(body)];
  const bool again = its.phase >= substep_;
  if (!again) group.struck.push_back(body);
  its = {phase_, again, !bounces || (again && its.stopped)};
  if (!wait_within_part(body)) return;
  if (joins_parts(group))
    wait_across(body);
  else
    group.outward.push_back(body);
}

inline bool BounceQueue::bounce_at(Group& group, std::uint32_t i, Contacts& contacts,
                                   BodyRows<SolverBody> bodies, const BounceRule& rule) {
  const Entry& entry = group.entries[i];
  const bool is_new = std::exchange(group.prepared[i], phase_) != phase_;
  if (i < group.discs) {
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

inline void BounceQueue::look_at(Group& group, std::uint32_t i, Contacts& contacts,
                                 BodyRows<SolverBody> bodies, const BounceRule& rule) {
  const Entry& entry = group.entries[i];
  const SolverBody &a = bodies[entry.a], &b = bodies[entry.b];
  const bool is_lone = is_lone_bounce(group, i, bodies);
  const Bounce before = is_lone ? Bounce{i, {a.velocity, a.spin}, {b.velocity, b.spin}} : Bounce();
  if (!bounce_at(group, i, contacts, bodies, rule)) return;
  if (is_lone) group.bounces.push_back(before);
  note_strike(group, entry.a, entry.bounces, bodies), note_strike(group, entry.b, entry.bounces, bodies);
}

/// Whether the two of an entry are so far from each other, at the substep's end, that they can't have met in
/// it, whatever way they took at these speeds, and one at `before` (m/s), too.
bool BounceQueue::is_far(const Group& group, std::uint32_t i, BodyRows<const SolverBody> bodies,
                         const BounceRule& rule, double before) const {
  const Entry& entry = group.entries[i];
  const SolverBody &a = bodies[entry.a], &b = bodies[entry.b];
  const double speeds = before + a.velocity.norm() + b.velocity.norm() + 2.0 * rule.kick.norm();
  const Vec between = b.position - a.position;
  if (i < group.discs) {
    const double near = entry.touch + 2.0 * rule.h * speeds;
    return (rule.period ? nearest_image(between, *rule.period) : between).squaredNorm() > near * near;
  }
  const Reach& reach = group.reaches[i - group.discs];
  const double turned = (std::abs(a.turn) + 2.0 * rule.h * std::abs(a.spin)) * reach.of_a +
                        (std::abs(b.turn) + 2.0 * rule.h * std::abs(b.spin)) * reach.of_b;
  return reach.normal != Vec(0.0, 0.0) &&
         reach.normal.dot(between) - entry.touch - turned > 2.0 * rule.h * speeds;
}

/// Whether all whom a body may touch, but for that one entry, are far.
bool BounceQueue::nobody_is_near(std::uint32_t body, const Entry& but, double before,
                                 BodyRows<const SolverBody> bodies, const BounceRule& rule) const {
  if (!bodies[body].is_dynamic()) return true;
  for (std::uint32_t k = first_of_[body]; k < first_of_[body + 1]; ++k) {
    const bool across = of_body_[k] & kAcross;
    const Group& group = across ? groups_.back() : groups_[parts_->group(body)];
    const std::uint32_t i = across ? of_body_[k] & ~kAcross : of_body_[k];
    if (&group.entries[i] != &but && !is_far(group, i, bodies, rule, before)) return false;
  }
  return true;
}

void BounceQueue::land(Contacts& contacts, BodyRows<SolverBody> bodies, const FreeFall& free_fall,
                       const BounceRule& rule) {
  for (Group& group : groups_)
    for (const auto& [i, a, b] : group.bounces) {
      const Entry& entry = group.entries[i];
      const auto alone = [&](std::uint32_t row, const Velocities& before) {
        return !strikes_[bodies.slot(row)].again && free_fall.flies(bodies, row) &&
               nobody_is_near(row, entry, before.linear.norm(), bodies, rule);
      };
      if (group.prepared[i] != substep_ || !alone(entry.a, a) || !alone(entry.b, b)) continue;
      if (i < group.discs)
        bounce_as_they_meet(std::span(contacts.disc_bounces).subspan(entry.first, 1), a, b, bodies, rule,
                            told_);
      else
        bounce_as_they_meet(std::span(contacts.point_bounces).subspan(entry.first, entry.count), a, b, bodies,
                            rule, told_);
    }
}

void BounceQueue::sweep(Group& group, Contacts& contacts, BodyRows<SolverBody> bodies,
                        const BounceRule& rule) {
  BounceRule in_course = rule;
  in_course.hit_speed = rule.follow_speed;
  const auto was_struck = [&](std::uint32_t body) { return strikes_[bodies.slot(body)].phase == phase_; };
  for (std::size_t word = 0; word < group.waiting.size(); ++word) {
    std::uint64_t ahead = asked(group)[word];
    while (const std::uint64_t left = group.waiting[word] & ahead) {
      const std::uint64_t bit = left & -left;
      ahead &= ~(bit | (bit - 1));
      group.waiting[word] &= ~bit;
      const std::uint32_t i =
          static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(bit));
      const Entry& entry = group.entries[i];
      look_at(group, i, contacts, bodies, was_struck(entry.a) || was_struck(entry.b) ? in_course : rule);
    }
  }
}

bool BounceQueue::sweep(Contacts& contacts, BodyRows<SolverBody> bodies, const BounceRule& rule,
                        Workers& workers) {
  std::size_t wait = 0;
  for (const Group& group : groups_) wait += count_waiting(group);
  const bool shared = wait >= kMany;
  if (shared && !joined_) join(bodies);
  for_groups(parts_->count(), shared, workers, [&](Group& part) {
    part.outward.clear();
    sweep(part, contacts, bodies, rule);
  });
  for (std::size_t part = 0; part < parts_->count(); ++part)
    for (const std::uint32_t body : groups_[part].outward) wait_across(body);
  if (groups_.size() > 1) sweep(groups_.back(), contacts, bodies, rule);
  return std::ranges::any_of(groups_, [&](const Group& group) { return count_waiting(group) > 0; });
}

}  // namespace throng
