// SPDX-License-Identifier: MIT
#include "sim/contact/soft_discs.h"

#include <algorithm>
#include <numeric>

#include "sim/contact/contact_key.h"
#include "sim/contact/roll.h"
#include "sim/periodic.h"

namespace throng {

SoftDiscs::SoftDiscs(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), ratios_(damping_ratios(plan)), radius_(scene.bodies.size()) {}

void SoftDiscs::find(const Candidates& candidates, const State& state, const SoftPlaces& places,
                     std::span<const SolverBody> bodies) {
  for (std::uint32_t place = 0; place < radius_.size(); ++place)
    radius_[place] = scene_.bodies.radius[places.row(place)];
  list_candidates(candidates, state, places);
  sort_candidates(bodies.size());
  pairs_.clear(), laws_.clear(), shifts_.clear(), touches_.clear();
  for (const Candidate& candidate : sorted_) {
    add(candidate, candidates, places, bodies);
    if (candidate.kept == kNone) continue;
    const ContactImpulse& kept = state.disc_contacts[candidate.kept];
    const auto [a, b] = candidate.pair;
    const auto pair = static_cast<std::uint32_t>(pairs_.size() - 1);
    touches_.push_back({Vec(1.0, 0.0), {kept.tangent, kept.rolling}, 0.0, 0.0, a, b, pair});
  }
  squeeze_ = {};
}

/// Both ascend by key: the candidates, and what the state has kept.
void SoftDiscs::list_candidates(const Candidates& candidates, const State& state, const SoftPlaces& places) {
  const Colliders& colliders = candidates.colliders();
  found_.clear();
  std::uint32_t next = 0;
  for (const broadphase::Pair& pair : candidates.pairs()) {
    if (!is_disc(colliders, pair.a) || !is_disc(colliders, pair.b)) continue;
    const std::uint64_t key = key_of(pair, false);
    while (next < state.disc_contacts.size() && state.disc_contacts[next].key < key) ++next;
    const bool kept = next < state.disc_contacts.size() && state.disc_contacts[next].key == key;
    found_.push_back({key,
                      pair,
                      {places.place(colliders.body[pair.a]), places.place(colliders.body[pair.b])},
                      kept ? next : kNone});
  }
}

/// Counts how many begin at each place.
void SoftDiscs::sort_candidates(std::size_t places) {
  const auto first = [](const Candidate& candidate) { return std::min(candidate.pair.a, candidate.pair.b); };
  start_.assign(places + 1, 0);
  for (const Candidate& candidate : found_) ++start_[first(candidate) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  sorted_.resize(found_.size());
  for (const Candidate& candidate : found_) sorted_[start_[first(candidate)]++] = candidate;
}

void SoftDiscs::add(const Candidate& candidate, const Candidates& candidates, const SoftPlaces& places,
                    std::span<const SolverBody> bodies) {
  const auto [a, b] = candidate.pair;
  const std::size_t row =
      scene_.bodies.material[places.row(a)] * scene_.materials.size() + scene_.bodies.material[places.row(b)];
  const double mass = 1.0 / (bodies[a].inverse_mass + bodies[b].inverse_mass);
  const double radius = effective_radius(radius_[a], radius_[b]);
  SoftPair law = soft_pair(scene_, mass, radius, ratios_[row]);
  law.friction = plan_.surfaces[row].friction;
  law.rolling = plan_.surfaces[row].rolling, law.roll_radius = radius;
  pairs_.push_back(candidate.pair), laws_.push_back(law);
  if (plan_.periodic) shifts_.push_back(candidates.shift(candidate.colliders));
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
  std::ranges::sort(touches_, {}, [&](const Touch& touch) { return sorted_[touch.pair].key; });
}

[[gnu::always_inline]] inline Vec SoftDiscs::between(std::size_t pair, const SoftSubstep& now) const {
  const auto [a, b] = pairs_[pair];
  const Vec way = now.bodies[b].position - now.bodies[a].position;
  return shifts_.empty() ? way : Vec(way + shifts_[pair]);
}

/// Lists which of the pairs from `first` to `last` may be in contact in this substep; `batch` has room for
/// all of them. Without a branch for each.
std::size_t SoftDiscs::find_near(std::size_t first, std::size_t last, const SoftSubstep& now,
                                 Batch& batch) const {
  std::size_t count = 0;
  for (std::size_t i = first; i < last; ++i) {
    const auto [a, b] = pairs_[i];
    const double reach = radius_[a] + radius_[b], seen = reach + now.fringe;
    const Vec way = between(i, now);
    batch[count] = {way, {}, reach, 0.0, a, b, static_cast<std::uint32_t>(i)};
    count += way.squaredNorm() < seen * seen;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double distance = batch[k].normal.norm();
    batch[k].depth -= distance;
    batch[k].normal = distance > 0.0 ? Vec(batch[k].normal / distance) : Vec(1.0, 0.0);
  }
  return count;
}

template <class Law>
void SoftDiscs::press(const Law& law, const SoftSubstep& now) {
  Batch batch;
  std::size_t next = 0;
  for (std::size_t first = 0; first < pairs_.size(); first += kBatch) {
    const std::size_t count = find_near(first, std::min(first + kBatch, pairs_.size()), now, batch);
    for (std::size_t k = 0; k < count; ++k) press(law, batch[k], now, next);
  }
}

template <class Law>
[[gnu::always_inline]] inline void SoftDiscs::press(const Law& law, Touch touch, const SoftSubstep& now,
                                                    std::size_t& next) {
  const auto [a, b] = pairs_[touch.pair];
  const SoftMotion moves = motion(touch, now.bodies[a], now.bodies[b]);
  if (!(touch.depth + std::abs(0.5 * now.h * moves.closing) > 0.0)) return;
  if (touch.depth > SoftSqueeze::kMost * std::min(radius_[a], radius_[b])) squeeze_.note(a, b, touch.depth);
  touch.springs = springs_of(touch, moves, now, next);
  SoftSprings trial = touch.springs;
  push(touch, soft_force(law, laws_[touch.pair], moves, now.h, plan_.rolling, trial), now.pushes);
  touches_.push_back(touch);
}

void SoftDiscs::press(const SoftSubstep& now) {
  std::swap(touches_, last_);
  touches_.clear();
  with_law(scene_, [&](const auto& law) { press(law, now); });
}

void SoftDiscs::press_again(const SoftSubstep& now) {
  with_law(scene_, [&](const auto& law) {
    for (Touch& touch : touches_) {
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
        {sorted_[touch.pair].key, 0, h * touch.force, touch.springs.slip, touch.springs.roll});
}

void SoftDiscs::list(const State& state, double h, const SoftPlaces& places,
                     std::span<const SolverBody> bodies, std::vector<ContactRow>& rows) const {
  for (const Touch& touch : touches_) {
    if (!(touch.force > 0.0)) continue;
    const std::uint32_t a = places.row(touch.a), b = places.row(touch.b);
    const Vec point = bodies[a].position + arm(touch.a, touch.depth) * touch.normal;
    rows.push_back(
        {state.id[a], state.id[b], h * touch.force, plan_.periodic ? wrapped(point, scene_.domain) : point});
  }
}

}  // namespace throng
