// SPDX-License-Identifier: MIT
#include "sim/contact/soft_solids.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/contact/contact_key.h"
#include "sim/contact/roll.h"
#include "sim/contact/soft_touch.h"
#include "sim/periodic.h"

namespace throng {

using narrowphase::Pose;

SoftSolids::SoftSolids(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), ratios_(damping_ratios(plan)) {}

void SoftSolids::find(const Candidates& candidates, const State& state, const SoftPlaces& places,
                      std::span<const SolverBody> bodies) {
  pairs_.clear(), turning_.clear();
  find_kinematic(candidates, state, places, bodies);
  find_obstacles(candidates, places, bodies);
  by_disc_.resize(pairs_.size());
  std::iota(by_disc_.begin(), by_disc_.end(), 0u);
  std::ranges::sort(by_disc_, [&](std::uint32_t i, std::uint32_t j) {
    return pairs_[i].disc < pairs_[j].disc || (pairs_[i].disc == pairs_[j].disc && i < j);
  });
  recall(state);
  squeeze_ = {};
}

void SoftSolids::find_kinematic(const Candidates& candidates, const State& state, const SoftPlaces& places,
                                std::span<const SolverBody> bodies) {
  if (!plan_.polygons) return;
  const Colliders& colliders = candidates.colliders();
  for (const broadphase::Pair& pair : candidates.pairs()) {
    const bool first = is_disc(colliders, pair.a);
    if (first && is_disc(colliders, pair.b)) continue;
    const std::uint32_t disc = colliders.body[first ? pair.a : pair.b], row = first ? pair.b : pair.a;
    const std::uint32_t solid = colliders.body[row];
    const Vec shift = first ? candidates.shift(pair) : Vec(-candidates.shift(pair));
    add({key_of(pair, false),
         places.place(disc),
         places.place(solid),
         0.0,
         nullptr,
         colliders.shape[row],
         shift,
         {}},
        disc, scene_.bodies.material[solid], bodies[places.place(disc)]);
    turning_.push_back({places.place(solid), state.angle[solid]});
  }
  std::ranges::sort(turning_, {}, &Turning::body);
  const auto same = [](const Turning& one, const Turning& other) { return one.body == other.body; };
  turning_.erase(std::unique(turning_.begin(), turning_.end(), same), turning_.end());
  poses_.resize(bodies.size());
}

void SoftSolids::find_obstacles(const Candidates& candidates, const SoftPlaces& places,
                                std::span<const SolverBody> bodies) {
  const Obstacles& obstacles = candidates.obstacles();
  const auto last = static_cast<std::uint32_t>(bodies.size() - 1);
  for (const broadphase::Pair& pair : candidates.obstacle_pairs()) {
    const auto* side = obstacles.is_side(pair.b) ? &obstacles.side[pair.b] : nullptr;
    const auto* part = side ? nullptr : &obstacles.part_at(pair.b);
    const std::uint32_t disc = candidates.colliders().body[pair.a], place = places.place(disc);
    add({key_of(pair, true), place, last, 0.0, side, part, candidates.obstacle_shift(pair.a), {}}, disc,
        obstacles.material[pair.b], bodies[place]);
  }
}

/// `disc`: its row.
void SoftSolids::add(Pair pair, std::uint32_t disc, std::uint32_t material, const SolverBody& body) {
  const std::size_t row = plan_.surface_row(scene_.bodies.material[disc], material);
  pair.radius = scene_.bodies.radius[disc];
  const double radius = effective_radius(pair.radius, pair.part ? rolling_radius(*pair.part) : 0.0);
  pair.law = soft_pair(scene_, 1.0 / body.inverse_mass, radius, ratios_[row]);
  pair.law.friction = plan_.surfaces[row].friction;
  pair.law.rolling = plan_.surfaces[row].rolling, pair.law.roll_radius = radius;
  pairs_.push_back(pair);
}

/// Both ascend by key.
void SoftSolids::recall(const State& state) {
  touches_.clear();
  std::uint32_t next = 0;
  for (const ContactImpulse& kept : state.point_contacts) {
    while (next < pairs_.size() && pairs_[next].key < kept.key) ++next;
    if (next == pairs_.size()) return;
    if (pairs_[next].key == kept.key)
      touches_.push_back({next, next, 0.0, Vec(1.0, 0.0), Vec(0.0, 0.0), {kept.tangent, kept.rolling}, 0.0});
  }
}

void SoftSolids::press(const SoftSubstep& now) {
  std::swap(touches_, last_);
  touches_.clear(), pushes_.clear();
  added_ = pressed_ = 0;
  for (const auto& [body, angle] : turning_)
    poses_[body] = narrowphase::pose(now.bodies[body].position, angle + now.bodies[body].turn);
  with_law(scene_, [&](const auto& law) {
    for (auto own = by_disc_.begin(); own != by_disc_.end();) {
      const auto end = std::find_if(own, by_disc_.end(),
                                    [&](std::uint32_t i) { return pairs_[i].disc != pairs_[*own].disc; });
      press_disc(law, {own, end}, now);
      own = end;
    }
  });
  std::ranges::sort(touches_, {}, &Touch::pair);
  by_place_.resize(touches_.size());
  std::iota(by_place_.begin(), by_place_.end(), 0u);
  std::ranges::sort(by_place_, {},
                    [&](std::uint32_t i) { return std::pair(pairs_[touches_[i].pair].disc, i); });
}

void SoftSolids::add_pushes(const SoftSubstep& now, std::uint32_t end) {
  for (; added_ < pushes_.size() && pushes_[added_].disc < end; ++added_) add(pushes_[added_], now.pushes);
}

template <class Law>
void SoftSolids::press_disc(const Law& law, std::span<const std::uint32_t> pairs, const SoftSubstep& now) {
  find_near(pairs, now);
  if (near_.size() > 1) drop_shared(now);
  for (Touch& touch : near_) {
    const Pair& pair = pairs_[touch.pair];
    const SolverBody& disc = now.bodies[pair.disc];
    const SoftMotion moves = motion(touch, now, disc.velocity, disc.spin);
    if (!(touch.depth + std::abs(0.5 * now.h * moves.closing) > 0.0)) continue;
    if (touch.depth > SoftSqueeze::kMost * pair.radius) squeeze_.note(pair.disc, pair.solid, touch.depth);
    touch.springs = springs_of(touch, moves, now);
    SoftSprings trial = touch.springs;
    pushes_.push_back(push_of(touch, soft_force(law, pair.law, moves, now.h, plan_.rolling, trial)));
    touches_.push_back(touch);
  }
}

/// What the disc may touch in this substep.
void SoftSolids::find_near(std::span<const std::uint32_t> pairs, const SoftSubstep& now) {
  near_.clear();
  for (const std::uint32_t i : pairs) {
    const Pair& pair = pairs_[i];
    const NearestSurface surface = nearest(pair, now.bodies[pair.disc].position);
    const double depth = pair.radius - surface.distance;
    if (!(depth + now.fringe > 0.0)) continue;
    const double arm = pair.radius - std::max(depth, 0.0);
    const Vec place = now.bodies[pair.disc].position + arm * surface.normal;
    const Vec lever = place - (now.bodies[pair.solid].position + pair.shift);
    near_.push_back({i, i, depth, surface.normal, lever, {}, 0.0});
  }
}

/// Of the places where a disc touches, those that lie on a solid that it is deeper in belong to that one, and
/// so do their springs as the disc gets from the one to the other.
void SoftSolids::drop_shared(const SoftSubstep& now) {
  std::ranges::sort(near_, [](const Touch& one, const Touch& other) {
    return one.depth > other.depth || (one.depth == other.depth && one.pair < other.pair);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const Pair& pair = pairs_[near_[i].pair];
    const double radius = pair.radius;
    const Vec place = now.bodies[pair.disc].position + (radius - near_[i].depth) * near_[i].normal;
    const auto end = near_.begin() + static_cast<std::ptrdiff_t>(kept);
    const auto owner = std::find_if(near_.begin(), end, [&](const Touch& touch) {
      return std::abs(nearest(pairs_[touch.pair], place).distance) <= kSame * radius;
    });
    if (owner == end)
      near_[kept++] = near_[i];
    else if (!before(owner->heir_of))
      owner->heir_of = near_[i].pair;
  }
  near_.resize(kept);
}

NearestSurface SoftSolids::nearest(const Pair& pair, const Vec& point) const {
  if (pair.side) return nearest_surface(point, *pair.side);
  if (poses_.empty()) return nearest_surface(point, *pair.part, Pose{pair.shift});
  Pose pose = poses_[pair.solid];
  pose.position += pair.shift;
  return nearest_surface(point, *pair.part, pose);
}

/// From the disc's centre to the solid, m.
double SoftSolids::arm(const Touch& touch) const {
  return pairs_[touch.pair].radius - std::max(touch.depth, 0.0);
}

/// The solid keeps its velocity; `velocity` and `spin` are the disc's.
SoftMotion SoftSolids::motion(const Touch& touch, const SoftSubstep& now, const Vec& velocity,
                              double spin) const {
  const SolverBody& solid = now.bodies[pairs_[touch.pair].solid];
  const Vec apart = solid.velocity + solid.spin * tangent(touch.lever) - velocity;
  return {touch.depth, -apart.dot(touch.normal), apart.dot(tangent(touch.normal)) - arm(touch) * spin,
          solid.spin - spin};
}

/// As those of SoftDiscs.
SoftSprings SoftSolids::springs_after(const Touch& touch, const SoftSubstep& now) const {
  const SolverBody& disc = now.bodies[pairs_[touch.pair].disc];
  const SoftMotion moves = motion(touch, now, disc.velocity, disc.spin);
  SoftSprings springs = touch.springs;
  stretch(springs, moves, contact_time_after(moves, 0.5 * now.h), plan_.rolling);
  return springs;
}

SoftSprings SoftSolids::springs_of(const Touch& touch, const SoftMotion& moves,
                                   const SoftSubstep& now) const {
  const Touch* known = before(touch.heir_of);
  SoftSprings springs;
  if (known) springs = now.first ? known->springs : springs_after(*known, now);
  stretch(springs, moves, contact_time_before(moves, known ? 0.5 * now.h : now.past), plan_.rolling);
  return springs;
}

void SoftSolids::finish(const SoftSubstep& now) {
  for (Touch& touch : touches_) touch.springs = springs_after(touch, now);
}

SoftSolids::Push SoftSolids::push_of(const Touch& touch, const SoftForce& force) const {
  return {pairs_[touch.pair].disc,
          {force.normal * touch.normal + force.tangent * tangent(touch.normal),
           arm(touch) * force.tangent + force.torque}};
}

void SoftSolids::add(const Push& push, std::span<SoftPush> pushes) {
  pushes[push.disc].force -= push.push.force;
  pushes[push.disc].torque -= push.push.torque;
}

/// In the substep before; null where they were apart.
const SoftSolids::Touch* SoftSolids::before(std::uint32_t pair) const {
  const auto found = std::ranges::lower_bound(last_, pair, {}, &Touch::pair);
  return found != last_.end() && found->pair == pair ? &*found : nullptr;
}

void SoftSolids::press_again(const SoftSubstep& now, std::uint32_t end) {
  with_law(scene_, [&](const auto& law) {
    for (; pressed_ < by_place_.size(); ++pressed_) {
      Touch& touch = touches_[by_place_[pressed_]];
      const Pair& pair = pairs_[touch.pair];
      if (pair.disc >= end) return;
      const SoftSpeed& disc = now.speeds[pair.disc];
      const SoftMotion moves = motion(touch, now, disc.velocity, disc.spin);
      const SoftForce force = soft_force(law, pair.law, moves, now.h, plan_.rolling, touch.springs);
      touch.force = force.normal;
      add(push_of(touch, force), now.pushes);
    }
  });
}

void SoftSolids::save(double h, State& state) const {
  state.point_contacts.clear();
  for (const Touch& touch : touches_)
    state.point_contacts.push_back(
        {pairs_[touch.pair].key, 0, h * touch.force, touch.springs.slip, touch.springs.roll});
}

void SoftSolids::list(const State& state, double h, const SoftPlaces& places,
                      std::span<const SolverBody> bodies, std::vector<ContactRow>& rows) const {
  for (const Touch& touch : touches_) {
    if (!(touch.force > 0.0)) continue;
    const Pair& pair = pairs_[touch.pair];
    const std::uint32_t disc = places.row(pair.disc), solid = places.row(pair.solid);
    const Vec point = bodies[disc].position + arm(touch) * touch.normal;
    rows.push_back({state.id[disc], solid < state.id.size() ? state.id[solid] : 0, h * touch.force,
                    plan_.periodic ? wrapped(point, scene_.domain) : point});
  }
}

}  // namespace throng
