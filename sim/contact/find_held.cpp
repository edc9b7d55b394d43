// SPDX-License-Identifier: MIT
// What ContactFinder does for pairs of polygons that have hardly moved.
#include <algorithm>

#include "narrowphase/relative.h"
#include "sim/contact/contact_key.h"
#include "sim/contact/find_contacts.h"
#include "sim/contact/kept_impulses.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::HeldFace;
using narrowphase::Manifold;
using narrowphase::Pose;

namespace {

constexpr std::size_t kMostVertices = 32;  // to hold a face looks at each vertex of each edge
constexpr double kWorthwhile = 8.0;        // steps that it must hold for
constexpr int kRest = 240;                 // finds for which nothing is held
constexpr int kMostInVain = 8;             // finds in a row of which most was searched
constexpr double kSlow = 0.1;  // of the smaller radius: who moves more in so many steps isn't held

}  // namespace

/// Where most pairs must be searched anyway, as all fall or are stirred, holding costs more than it saves.
/// Not where that is so for a moment, as in a step that is taken again and looks farther.
bool ContactFinder::is_worth_holding() {
  if (rests_ > 0) {
    --rests_;
    return false;
  }
  in_vain_ = 4 * held_.known() < 3 * held_.named() ? in_vain_ + 1 : 0;
  if (in_vain_ < kMostInVain) return true;
  held_.forget_all();
  in_vain_ = 0, rests_ = kRest;
  return false;
}

/// Polygons that are all of their body: what is left of contacts with a part depends on its neighbours.
void ContactFinder::find_who_may_be_held(const Colliders& colliders) {
  placed_.resize(colliders.size());
  for (std::uint32_t row = 0; row < colliders.size(); ++row) {
    const bool alone = colliders.rim.empty() || colliders.rims[colliders.rim[row]].empty();
    const std::size_t vertices = is_disc(colliders, row) ? 0 : colliders.shape[row]->vertices.size();
    may_be_held_.push_back(alone && vertices > 2 && vertices <= kMostVertices);
  }
}

void ContactFinder::name_lanes() {
  held_.start();
  for (Touch& touch : touches_)
    if (!touch.obstacle && may_be_held_[touch.pair.a] && may_be_held_[touch.pair.b])
      touch.lane = held_.lane_of(touch.key(), touch.pair);
  held_.finish();
}

PlacedPart ContactFinder::place_part(const Candidates& candidates, const State& state,
                                     std::span<const SolverBody> bodies, std::uint32_t collider) const {
  const Colliders& colliders = candidates.colliders();
  const std::uint32_t row = colliders.body[collider];
  const SolverBody& body = bodies[row];
  const Pose at = candidates.pose(state, row);
  const double reach = candidates.reach(collider);
  const double arm = colliders.centre[collider].norm() + colliders.radius[collider] + reach;
  const double pace = body.velocity.norm() + std::abs(body.spin) * arm;
  return {at.position.x(),   at.position.y(),      at.cos, at.sin,
          body.inverse_mass, body.inverse_inertia, reach,  pace};
}

void ContactFinder::answer_held(const Candidates& candidates, const State& state,
                                std::span<const SolverBody> bodies, Workers& workers) {
  if (may_be_held_.empty()) find_who_may_be_held(candidates.colliders());
  name_lanes();
  const Rows rows = candidates.rows();
  workers.for_ranges(rows.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (may_be_held_[rows[i]]) placed_[rows[i]] = place_part(candidates, state, bodies, rows[i]);
  });
  workers.for_ranges(touches_.size(), [&](std::size_t begin, std::size_t end) {
    KeptImpulses memory(state.point_contacts, touches_[begin].key());
    for (std::size_t i = begin; i < end; ++i) {
      if (touches_[i].lane == HeldFaces::kNone) continue;
      const ContactImpulse* kept = memory.find(touches_[i].key());
      held_.ask(touches_[i].lane, kept ? &kept->feature : nullptr,
                plan_.periodic ? &touches_[i].shift : nullptr);
    }
  });
  workers.for_ranges(held_.blocks(),
                     [&](std::size_t begin, std::size_t end) { held_.answer(begin, end, placed_, fast_); });
}

/// What comes some touches later, a block of lanes at a time.
void ContactFinder::fetch_held(std::size_t touch, std::size_t end) const {
  constexpr std::size_t kAheadInTouches = 12;
  const std::size_t later = touch + kAheadInTouches;
  if (later >= end || touches_[later].lane == HeldFaces::kNone) return;
  const std::uint32_t block = touches_[later].lane / BlockOrder::kWidth;
  if (touches_[later - 1].lane / BlockOrder::kWidth != block) held_.fetch(touches_[later].lane);
}

void ContactFinder::fill_held(const Colliders& colliders, std::size_t touch, KeptImpulses& memory,
                              Contacts& contacts) {
  const auto& [pair, obstacle, shift, lane] = touches_[touch];
  const std::size_t first = first_point_[touch];
  const std::span<std::uint32_t> features = names(touch, contacts);
  for (std::size_t p = 0; p < features.size(); ++p) features[p] = held_.feature(lane, p);
  std::array<BlockImpulses, 2> impulses{};
  for (std::size_t p = 0; p < features.size(); ++p)
    if (const ContactImpulse* kept = memory.find(touches_[touch].key(), features, p))
      impulses[p] = {kept->normal, kept->tangent, kept->preload};
  const Surface& surface =
      this->surface(colliders.body[pair.a], scene_.bodies.material[colliders.body[pair.b]]);
  contacts.faces.fill(first, held_.block(lane), lane % BlockOrder::kWidth, surface.friction, impulses);
}

/// After a search that found the touch's manifold.
void ContactFinder::hold(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                         std::size_t touch) {
  const Colliders& colliders = candidates.colliders();
  const auto& [pair, obstacle, shift, lane] = touches_[touch];
  const SolverBody &a = bodies[colliders.body[pair.a]], &b = bodies[colliders.body[pair.b]];
  const double radius_a = colliders.radius[pair.a], radius_b = colliders.radius[pair.b];
  const double steps = kWorthwhile * scene_.time.dt, spin = std::abs(a.spin) + std::abs(b.spin);
  const double speed = (b.velocity - a.velocity).norm(), widest = 2.0 * (radius_a + radius_b);
  if (steps * (speed + widest * spin) > kSlow * std::min(radius_a, radius_b)) return;
  Pose pose_b = candidates.pose(state, colliders.body[pair.b]);
  pose_b.position += shift;
  const Pose b_in_a = narrowphase::relative(candidates.pose(state, colliders.body[pair.a]), pose_b);
  const Manifold& m = manifolds_[touch];
  if (!held_.wants_hold(lane, m.count > 0 ? &m.points[0].feature : nullptr, b_in_a)) return;
  const Convex &shape_a = *colliders.shape[pair.a], &shape_b = *colliders.shape[pair.b];
  const HeldFace held = narrowphase::hold(shape_a, shape_b, b_in_a, m);
  const double enough =
      held.kind == HeldFace::Kind::apart ? candidates.reach(pair) + shape_a.radius + shape_b.radius : 0.0;
  held_.hold(lane, held, shape_a, shape_b, enough + steps * (speed + held.lever * spin));
}

}  // namespace throng
