// SPDX-License-Identifier: MIT
#include "sim/contact/soft_discs.h"

#include "sim/contact/contact_key.h"
#include "sim/contact/roll.h"
#include "sim/periodic.h"

namespace throng {

SoftDiscs::SoftDiscs(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), ratios_(damping_ratios(plan)), radius_(scene.bodies.radius) {}

void SoftDiscs::find(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies) {
  const Colliders& colliders = candidates.colliders();
  pairs_.clear(), keys_.clear(), laws_.clear(), shifts_.clear();
  for (const broadphase::Pair& pair : candidates.pairs()) {
    if (!is_disc(colliders, pair.a) || !is_disc(colliders, pair.b)) continue;
    const std::uint32_t a = colliders.body[pair.a], b = colliders.body[pair.b];
    const std::size_t row = scene_.bodies.material[a] * scene_.materials.size() + scene_.bodies.material[b];
    const double mass = 1.0 / (bodies[a].inverse_mass + bodies[b].inverse_mass);
    const double radius = effective_radius(radius_[a], radius_[b]);
    SoftPair law = soft_pair(scene_, mass, radius, ratios_[row]);
    law.friction = plan_.surfaces[row].friction;
    law.rolling = plan_.surfaces[row].rolling, law.roll_radius = radius;
    pairs_.push_back({a, b}), keys_.push_back(key_of(pair, false)), laws_.push_back(law);
    if (plan_.periodic) shifts_.push_back(candidates.shift(pair));
  }
  recall(state);
  squeeze_ = {};
}

/// Both ascend by key.
void SoftDiscs::recall(const State& state) {
  touches_.clear();
  std::size_t next = 0;
  for (const ContactImpulse& kept : state.disc_contacts) {
    while (next < keys_.size() && keys_[next] < kept.key) ++next;
    if (next == keys_.size()) return;
    if (keys_[next] != kept.key) continue;
    const auto [a, b] = pairs_[next];
    touches_.push_back(
        {Vec(1.0, 0.0), {kept.tangent, kept.rolling}, 0.0, 0.0, a, b, static_cast<std::uint32_t>(next)});
  }
}

/// From the body's centre to the middle of the overlap, m.
[[gnu::always_inline]] inline double SoftDiscs::arm(std::uint32_t body, double depth) const {
  return radius_[body] - 0.5 * std::max(depth, 0.0);
}

[[gnu::always_inline]] inline SoftMotion SoftDiscs::motion(const Touch& touch, const auto& a,
                                                           const auto& b) const {
  const Vec apart = b.velocity - a.velocity;
  const double turned = arm(touch.a, touch.depth) * a.spin + arm(touch.b, touch.depth) * b.spin;
  return {touch.depth, -apart.dot(touch.normal), apart.dot(tangent(touch.normal)) - turned, b.spin - a.spin};
}

[[gnu::always_inline]] inline void SoftDiscs::push(const Touch& touch, const SoftForce& force,
                                                   std::span<SoftPush> pushes) const {
  const Vec all = force.normal * touch.normal + force.tangent * tangent(touch.normal);
  SoftPush &a = pushes[touch.a], &b = pushes[touch.b];
  a.force -= all, b.force += all;
  a.torque -= arm(touch.a, touch.depth) * force.tangent + force.torque;
  b.torque -= arm(touch.b, touch.depth) * force.tangent - force.torque;
}

/// As the substep of `touch` ends: `now` has the velocities of then.
[[gnu::always_inline]] inline SoftSprings SoftDiscs::springs_after(const Touch& touch,
                                                                   const SoftSubstep& now) const {
  const SoftMotion moves = motion(touch, now.bodies[touch.a], now.bodies[touch.b]);
  SoftSprings springs = touch.springs;
  stretch(springs, moves, contact_time_after(moves, 0.5 * now.h), plan_.rolling);
  return springs;
}

/// Those of the substep before, stretched until now; questions ascend.
[[gnu::always_inline]] inline SoftSprings SoftDiscs::springs_of(const Touch& touch, const SoftMotion& moves,
                                                                const SoftSubstep& now,
                                                                std::size_t& next) const {
  while (next < last_.size() && last_[next].pair < touch.pair) ++next;
  const bool known = next < last_.size() && last_[next].pair == touch.pair;
  SoftSprings springs;
  if (known) springs = now.first ? last_[next].springs : springs_after(last_[next], now);
  stretch(springs, moves, contact_time_before(moves, known ? 0.5 * now.h : now.past), plan_.rolling);
  return springs;
}

void SoftDiscs::finish(const SoftSubstep& now) {
  for (Touch& touch : touches_) touch.springs = springs_after(touch, now);
}

/// Bodies stand anywhere in memory: what a pair to come will need is sent for.
[[gnu::always_inline]] inline void SoftDiscs::fetch(const Pair& pair, const SoftSubstep& now) const {
  for (const std::uint32_t body : {pair.a, pair.b})
    __builtin_prefetch(&now.bodies[body]), __builtin_prefetch(&now.pushes[body], 1);
}

[[gnu::always_inline]] inline Vec SoftDiscs::between(std::uint32_t pair, const SoftSubstep& now) const {
  const auto [a, b] = pairs_[pair];
  const Vec way = now.bodies[b].position - now.bodies[a].position;
  return shifts_.empty() ? way : Vec(way + shifts_[pair]);
}

/// Which pairs may be in contact in this substep, without a branch for each.
void SoftDiscs::find_near(const SoftSubstep& now) {
  near_.resize(pairs_.size());
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    if (i + kAhead < pairs_.size()) fetch(pairs_[i + kAhead], now);
    const double reach = radius_[pairs_[i].a] + radius_[pairs_[i].b] + now.fringe;
    near_[count] = i;
    count += between(i, now).squaredNorm() < reach * reach;
  }
  near_.resize(count);
}

template <class Law>
void SoftDiscs::press(const Law& law, const SoftSubstep& now) {
  find_near(now);
  std::size_t next = 0;
  for (std::size_t k = 0; k < near_.size(); ++k) {
    if (k + kAhead < near_.size()) fetch(pairs_[near_[k + kAhead]], now);
    const std::uint32_t i = near_[k];
    const auto [a, b] = pairs_[i];
    const SolverBody &body_a = now.bodies[a], &body_b = now.bodies[b];
    const Vec between = this->between(i, now);
    const double reach = radius_[a] + radius_[b];
    const double distance = between.norm();
    Touch touch{Vec(1.0, 0.0), {}, reach - distance, 0.0, a, b, i};
    if (distance > 0.0) touch.normal = between / distance;
    const SoftMotion moves = motion(touch, body_a, body_b);
    if (!(touch.depth + std::abs(0.5 * now.h * moves.closing) > 0.0)) continue;
    if (touch.depth > SoftSqueeze::kMost * std::min(radius_[a], radius_[b])) squeeze_.note(a, b, touch.depth);
    touch.springs = springs_of(touch, moves, now, next);
    SoftSprings trial = touch.springs;
    push(touch, soft_force(law, laws_[i], moves, now.h, plan_.rolling, trial), now.pushes);
    touches_.push_back(touch);
  }
}

void SoftDiscs::press(const SoftSubstep& now) {
  std::swap(touches_, last_);
  touches_.clear();
  with_law(scene_, [&](const auto& law) { press(law, now); });
}

void SoftDiscs::press_again(const SoftSubstep& now) {
  with_law(scene_, [&](const auto& law) {
    for (std::size_t i = 0; i < touches_.size(); ++i) {
      if (i + kAhead < touches_.size()) {
        const Touch& next = touches_[i + kAhead];
        for (const std::uint32_t body : {next.a, next.b})
          __builtin_prefetch(&now.speeds[body]), __builtin_prefetch(&now.pushes[body], 1);
      }
      Touch& touch = touches_[i];
      const SoftMotion moves = motion(touch, now.speeds[touch.a], now.speeds[touch.b]);
      const SoftForce force = soft_force(law, laws_[touch.pair], moves, now.h, plan_.rolling, touch.springs);
      touch.force = force.normal;
      push(touch, force, now.pushes);
    }
  });
}

void SoftDiscs::save(double h, State& state) const {
  state.disc_contacts.clear();
  for (const Touch& touch : touches_)
    state.disc_contacts.push_back(
        {keys_[touch.pair], 0, h * touch.force, touch.springs.slip, touch.springs.roll});
}

void SoftDiscs::list(const State& state, double h, std::span<const SolverBody> bodies,
                     std::vector<ContactRow>& rows) const {
  for (const Touch& touch : touches_) {
    if (!(touch.force > 0.0)) continue;
    const Vec point = bodies[touch.a].position + arm(touch.a, touch.depth) * touch.normal;
    rows.push_back({state.id[touch.a], state.id[touch.b], h * touch.force,
                    plan_.periodic ? wrapped(point, scene_.domain) : point});
  }
}

}  // namespace throng
