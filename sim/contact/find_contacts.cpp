// SPDX-License-Identifier: MIT
#include "sim/contact/find_contacts.h"

#include <algorithm>
#include <array>
#include <utility>

#include "sim/contact/arms.h"
#include "sim/contact/contact_key.h"
#include "sim/contact/describe_face.h"
#include "sim/contact/fast.h"
#include "sim/contact/find_rolls.h"
#include "sim/contact/midway.h"

namespace throng {

using broadphase::Pair;

ContactFinder::ContactFinder(const Scene& scene, const Plan& plan, const Colliders& colliders)
    : scene_(scene),
      plan_(plan),
      colliders_(colliders),
      hit_speed_(throng::hit_speed(scene, plan)),
      fall_(plan.gravity ? scene.gravity.norm() * scene.time.dt : 0.0),
      all_bounce_(std::ranges::all_of(plan.meeting, [](const Surface& s) { return s.restitution > 0.0; })),
      parts_(scene, plan),
      discs_(scene, plan),
      ahead_(scene, plan, colliders),
      stumbles_(scene.time.dt) {}

void ContactFinder::find(const StepStart& start, Contacts& contacts, Workers& workers) {
  const auto& [candidates, state, bodies] = start;
  contacts.start(bodies, parts_.groups());
  sort_out(candidates, contacts, workers);
  const bool moved = std::exchange(moved_, false);
  discs_.find(candidates, state, bodies, parts_, moved, contacts.disc_key, contacts.discs, workers);
  if (plan_.restitution)
    for (std::uint32_t i = 0; i < contacts.disc_key.size(); ++i) {
      contacts.disc_bounces.push_back(discs_.contact_of(colliders_, pair_of(contacts.disc_key[i]), bodies));
      contacts.disc_bounces.back().row = i;
    }
  find_touches(start, moved, contacts, workers);
  if (plan_.rolling) find_rolls(scene_, plan_, candidates, state, bodies, contacts);
  if (!all_bounce_) list_hits(start, contacts);
}

Touch ContactFinder::touch(Pair pair, bool obstacle, const Vec& shift) const {
  const std::vector<std::uint32_t>& body = colliders_.body;
  const std::uint32_t a = body[pair.a];
  const std::size_t b = obstacle ? scene_.bodies.size() + parts_.group(a) : body[pair.b];
  return {.pair = pair, .a = a, .b = static_cast<std::uint32_t>(b), .obstacle = obstacle, .shift = shift};
}

/// Pairs of two discs have their contacts' keys then; what else there is must be looked at.
void ContactFinder::sort_out(const Candidates& candidates, Contacts& contacts, Workers& workers) {
  touches_.clear();
  const std::span<const Pair> pairs = candidates.pairs();
  if (colliders_.shape.empty()) {
    contacts.disc_key.resize(pairs.size());
    workers.for_ranges(pairs.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) contacts.disc_key[i] = key_of(pairs[i], false);
    });
  } else {
    for (const Pair& pair : pairs) {
      if (is_disc(colliders_, pair.a) && is_disc(colliders_, pair.b))
        contacts.disc_key.push_back(key_of(pair, false));
      else
        touches_.push_back(touch(pair, false, candidates.shift(pair)));
    }
  }
  for (const Pair& pair : candidates.obstacle_pairs())
    touches_.push_back(touch(pair, true, candidates.obstacle_shift(pair.a)));
}

void ContactFinder::find_touches(const StepStart& start, bool moved, Contacts& contacts, Workers& workers) {
  FaceBlocks& faces = contacts.faces;
  hits_.assign(touches_.size(), 0);
  if (touches_.empty() && faces.lanes() == 0) return;
  const bool held = std::exchange(holds_, plan_.polygons && !plan_.restitution && is_worth_holding());
  if (holds_ != held) book_.forget_all(), held_.forget_all();
  if (holds_ && may_be_held_.empty()) find_who_may_be_held();
  name_lanes(faces);
  if (holds_) ask_held(start, workers), answer_held(faces, workers);
  search(start, workers);
  ++age_;
  if (moved || holds_ != held || !all_sit_well(faces)) {
    seat_anew(start.bodies, faces, workers);
    if (holds_) answer_held(faces, workers);
    age_ = 0;
  } else {
    for (const std::uint32_t block : held_again_)
      held_.answer(block, block + 1, placed_, held_speed(), faces.all_blocks());
  }
  take_seats(faces);
  fill_faces(start, contacts, workers);
}

/// What each touches with now, where that isn't known, and where two near each other fast what they will.
void ContactFinder::search(const StepStart& start, Workers& workers) {
  manifolds_.resize(touches_.size()), points_.resize(touches_.size());
  ahead_.start(touches_.size()), stumbles_.start(touches_.size());
  workers.for_ranges(touches_.size(), [&](std::size_t begin, std::size_t end) {
    if (begin == end) return;
    KeptImpulses memory(start.state.point_contacts, touches_[begin].key());
    for (std::size_t i = begin; i < end; ++i) {
      if (is_known(touches_[i]))
        points_[i] = held_.points(touches_[i].lane);
      else
        search_one(start, i, memory);
    }
  });
  take_out_stumbles(start, workers);
  ahead_.look(start, touches_, manifolds_, workers);
  for (const std::uint32_t i : ahead_.approaches())
    points_[i] = static_cast<std::uint8_t>(manifolds_[i].count);
  touch_midway({scene_.time.dt, start, touches_, ahead_, stumbles_}, manifolds_, points_, workers);
}

void ContactFinder::take_out_stumbles(const StepStart& start, Workers& workers) {
  for (const std::uint32_t touch : stumbles_.find(start, touches_, manifolds_, held_, workers)) {
    manifolds_[touch].count = points_[touch] = 0;
    ahead_.ask_nothing(touch);
  }
}

void ContactFinder::search_one(const StepStart& start, std::size_t touch, KeptImpulses& memory) {
  const Touch& one = touches_[touch];
  manifolds_[touch] = touch_manifold(start.candidates, one, touch_poses(start, one), memory.find(one.key()));
  points_[touch] = static_cast<std::uint8_t>(manifolds_[touch].count);
  ahead_.ask(start, touches_, touch, manifolds_[touch]);
  const bool may_stumble = stumbles_.ask(start, touches_, touch, manifolds_[touch]);
  if (!one.held) return;
  held_.ask_nothing(one.lane);  // of what is held from now on
  if (!may_stumble) hold(start, touch);
}

/// The points of a touch's manifold, without impulses.
std::span<PointContact> ContactFinder::face(const StepStart& start, std::size_t touch,
                                            std::array<PointContact, 2>& points) const {
  const Touch& one = touches_[touch];
  const Surface& surface = surface_of(scene_, plan_, start.obstacles(), one);
  return describe_face(start, one, surface, manifolds_[touch], ahead_.meeting(touch), scene_.time.dt, points);
}

void ContactFinder::fill_faces(const StepStart& start, Contacts& contacts, Workers& workers) {
  const std::size_t size = contacts.faces.size();
  contacts.point_key.resize(size), contacts.point_feature.resize(size);
  if (plan_.restitution) contacts.point_bounces.resize(size);
  turns_.assign(touches_.size(), 0);
  workers.for_ranges(touches_.size(), [&](std::size_t begin, std::size_t end) {
    if (begin == end) return;
    KeptImpulses memory(start.state.point_contacts, touches_[begin].key());
    std::array<PointContact, 2> points;  // here, as to make it takes longer than to fill it
    for (std::size_t i = begin; i < end; ++i) {
      fetch_held(i, end, contacts.faces);
      if (points_[i] == 0) continue;
      if (is_known(touches_[i]))
        fill_held(i, memory, contacts);
      else
        fill_searched(start, i, memory, points, contacts);
    }
  });
  list_turning(start, contacts);
}

void ContactFinder::list_bounces(std::span<const PointContact> face, std::uint32_t row, Contacts& contacts) {
  for (const PointContact& point : face) {
    contacts.point_bounces[row] = point;
    contacts.point_bounces[row].row = row;
    ++row;
  }
}

void ContactFinder::list_turning(const StepStart& start, Contacts& contacts) const {
  std::array<PointContact, 2> points;
  for (auto i = turns_.begin(); (i = std::find(i, turns_.end(), 1)) != turns_.end(); ++i) {
    const auto touch = static_cast<std::size_t>(i - turns_.begin());
    contacts.turning.add(first_point_[touch], face(start, touch, points));
  }
}

/// The keys and features under which the touch's points are kept.
std::span<std::uint32_t> ContactFinder::names(std::size_t touch, Contacts& contacts) const {
  const std::size_t first = first_point_[touch];
  std::fill_n(contacts.point_key.begin() + static_cast<std::ptrdiff_t>(first), points_[touch],
              touches_[touch].key());
  return std::span(contacts.point_feature).subspan(first, points_[touch]);
}

void ContactFinder::fill_searched(const StepStart& start, std::size_t touch, KeptImpulses& memory,
                                  std::array<PointContact, 2>& points, Contacts& contacts) {
  const std::span<PointContact> face = this->face(start, touch, points);
  const std::span<std::uint32_t> features = names(touch, contacts);
  for (std::size_t p = 0; p < face.size(); ++p) features[p] = manifolds_[touch].points[p].feature;
  for (std::size_t p = 0; p < face.size(); ++p) {
    const auto [normal, across, preload] = impulses_of(memory.find(touches_[touch].key(), features, p));
    face[p].normal_impulse = normal, face[p].tangent_impulse = across, face[p].preload = preload;
  }
  contacts.faces.fill(first_point_[touch], face);
  turns_[touch] = face[0].turner.body != Turner::Body::none;
  if (plan_.restitution) list_bounces(face, first_point_[touch], contacts);
  const SolverBody &a = start.bodies[face[0].a], &b = start.bodies[face[0].b];
  hits_[touch] = std::ranges::any_of(
      face, [&](const PointContact& c) { return arms(c).normal_velocity(a, b) < -hit_speed_; });
}

}  // namespace throng
