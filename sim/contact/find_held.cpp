// SPDX-License-Identifier: MIT
// What ContactFinder does for pairs of polygons that have hardly moved.
#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/relative.h"
#include "sim/contact/contact_key.h"
#include "sim/contact/fast.h"
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
  in_vain_ = 4 * held_.known() < 3 * named_ ? in_vain_ + 1 : 0;
  if (in_vain_ < kMostInVain) return true;
  in_vain_ = 0, rests_ = kRest;
  return false;
}

/// Polygons that are all of their body: what is left of contacts with a part depends on its neighbours.
void ContactFinder::find_who_may_be_held() {
  placed_.resize(colliders_.size());
  for (std::uint32_t row = 0; row < colliders_.size(); ++row) {
    const bool alone = colliders_.rim.empty() || colliders_.rims[colliders_.rim[row]].empty();
    const std::size_t vertices = is_disc(colliders_, row) ? 0 : colliders_.shape[row]->vertices.size();
    may_be_held_.push_back(alone && vertices > 2 && vertices <= kMostVertices);
  }
}

PlacedPart ContactFinder::place_part(const StepStart& start, std::uint32_t collider) const {
  const std::uint32_t row = colliders_.body[collider];
  const SolverBody& body = start.bodies[row];
  const Pose at = start.candidates.pose(start.state, row);
  const double reach = start.candidates.reach(collider);
  const double centre = colliders_.centre.empty() ? 0.0 : colliders_.centre[collider].norm();
  const double arm = centre + colliders_.radius[collider] + reach;
  const double pace = turns_far(body.spin, scene_.time.dt) ? std::numeric_limits<double>::infinity()
                                                           : body.velocity.norm() + std::abs(body.spin) * arm;
  return {at.position.x(),   at.position.y(),      at.cos, at.sin,
          body.inverse_mass, body.inverse_inertia, reach,  pace};
}

void ContactFinder::ask_held(const StepStart& start, Workers& workers) {
  const Rows rows = start.candidates.rows();
  workers.for_ranges(rows.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (may_be_held_[rows[i]]) placed_[rows[i]] = place_part(start, rows[i]);
  });
  workers.for_ranges(touches_.size(), [&](std::size_t begin, std::size_t end) {
    if (begin == end) return;
    KeptImpulses memory(start.state.point_contacts, touches_[begin].key());
    for (std::size_t i = begin; i < end; ++i) {
      if (!touches_[i].held) continue;
      const ContactImpulse* kept = memory.find(touches_[i].key());
      held_.ask(touches_[i].lane, kept ? &kept->feature : nullptr,
                plan_.periodic ? &touches_[i].shift : nullptr);
    }
  });
}

void ContactFinder::answer_held(FaceBlocks& faces, Workers& workers) {
  workers.for_ranges(held_.blocks(), [&](std::size_t begin, std::size_t end) {
    held_.answer(begin, end, placed_, held_speed(), faces.all_blocks());
  });
}

/// Lanes follow their faces to new seats.
void ContactFinder::hold_seats(FaceBlocks& faces) {
  moves_.clear();
  for (std::size_t i = 0; i < touches_.size(); ++i)
    if (touches_[i].held) moves_.push_back({touches_[i].pair, touches_[i].lane, seat_[i]});
  held_.move(faces.all_blocks().size(), moves_);
  auto move = moves_.begin();
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    if (!touches_[i].held) continue;
    seat_[i] = (move++)->to;
    if (points_[i] > 0) set_polygons(touches_[i], seat_[i], faces);
  }
}

void ContactFinder::set_polygons(const Touch& touch, std::uint32_t lane, FaceBlocks& faces) const {
  const std::vector<std::uint32_t>& material = scene_.bodies.material;
  faces.set_polygons(lane, plan_.surface(material[touch.a], material[touch.b]).friction);
}

/// What comes some touches later.
void ContactFinder::fetch_held(std::size_t touch, std::size_t end, const FaceBlocks& faces) const {
  constexpr std::size_t kAheadInTouches = 12;
  const std::size_t later = touch + kAheadInTouches;
  if (later >= end || points_[later] == 0) return;
  faces.fetch_impulses(touches_[later].lane);
  if (touches_[later].held) held_.fetch(touches_[later].lane);
}

void ContactFinder::fill_held(std::size_t touch, KeptImpulses& memory, Contacts& contacts) {
  const std::size_t first = first_point_[touch];
  const std::span<std::uint32_t> features = names(touch, contacts);
  for (std::size_t p = 0; p < features.size(); ++p) features[p] = held_.feature(touches_[touch].lane, p);
  for (std::size_t p = 0; p < features.size(); ++p)
    contacts.faces.set_impulses(first + p, impulses_of(memory.find(touches_[touch].key(), features, p)));
}

/// After a search that found the touch's manifold.
void ContactFinder::hold(const StepStart& start, std::size_t touch) {
  const Touch& one = touches_[touch];
  const auto& [row_a, row_b] = one.pair;
  const SolverBody &a = start.bodies[one.a], &b = start.bodies[one.b];
  const double radius_a = colliders_.radius[row_a], radius_b = colliders_.radius[row_b];
  const double steps = kWorthwhile * scene_.time.dt, spin = std::abs(a.spin) + std::abs(b.spin);
  const double speed = (b.velocity - a.velocity).norm(), widest = 2.0 * (radius_a + radius_b);
  if (steps * (speed + widest * spin) > kSlow * std::min(radius_a, radius_b)) return;
  const TouchPoses poses = touch_poses(start, one);
  const Pose b_in_a = narrowphase::relative(poses.a, poses.b);
  const Manifold& m = manifolds_[touch];
  if (!held_.wants_hold(one.lane, m.count > 0 ? &m.points[0].feature : nullptr, b_in_a)) return;
  const Convex &shape_a = *colliders_.shape[row_a], &shape_b = *colliders_.shape[row_b];
  const HeldFace face = narrowphase::hold(shape_a, shape_b, b_in_a, m);
  const double enough = face.kind == HeldFace::Kind::apart
                            ? start.candidates.reach(one.pair) + shape_a.radius + shape_b.radius
                            : 0.0;
  held_.hold(one.lane, face, shape_a, shape_b, enough + steps * (speed + face.lever * spin));
}

}  // namespace throng
