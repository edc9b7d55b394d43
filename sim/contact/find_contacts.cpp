// SPDX-License-Identifier: MIT
#include "sim/contact/find_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "narrowphase/half_plane.h"
#include "sim/contact/contact_key.h"
#include "sim/contact/find_rolls.h"
#include "sim/contact/memory.h"

namespace throng {

using broadphase::Pair;
using narrowphase::Convex;
using narrowphase::Manifold;
using narrowphase::ManifoldPoint;
using narrowphase::Pose;
using narrowphase::Reference;

namespace {

/// The face that described the contact of a and b in the last step.
Reference reference(std::span<const ContactImpulse> kept, const Convex& a, const Convex& b) {
  return kept.empty() ? Reference{} : narrowphase::reference(kept[0].feature, a, b);
}

/// The mass that bodies a and b show to an impulse along `direction` at those arms.
double effective_mass(const SolverBody& a, const SolverBody& b, const Vec& arm_a, const Vec& arm_b,
                      const Vec& direction) {
  const double turn_a = cross(arm_a, direction), turn_b = cross(arm_b, direction);
  return 1.0 / (a.inverse_mass + b.inverse_mass + a.inverse_inertia * turn_a * turn_a +
                b.inverse_inertia * turn_b * turn_b);
}

using narrowphase::Placed;
using narrowphase::Rim;

/// What is left of the contact of a and b once one of them is a piece of its whole: a seam matters to what is
/// smaller than the part beside it.
Manifold on_outline_of_a(const Manifold& m, const Placed& a, const Rim& rim, const Placed& b, double reach) {
  return rim.empty() ? m : on_outline(m, a, rim, b, reach);
}
Manifold on_outline_of_b(Manifold m, const Placed& a, const Placed& b, const Rim& rim, double reach) {
  if (rim.empty()) return m;
  m.normal = -m.normal;
  m = on_outline(m, b, rim, a, reach);
  m.normal = -m.normal;
  return m;
}

const Rim& rim(const Colliders& colliders, std::uint32_t row) {
  static const Rim alone;
  return colliders.rim.empty() ? alone : colliders.rims[colliders.rim[row]];
}

bool is_disc(const Colliders& colliders, std::uint32_t row) {
  return colliders.shape.empty() || !colliders.shape[row];
}

/// Fills in what one point of a manifold adds. `radius_a`, `radius_b`: of discs, whose arms are exact.
void place(PointContact& contact, const ManifoldPoint& point, const SolverBody& a, const SolverBody& b,
           const Vec& shift, double radius_a, double radius_b) {
  const Vec& n = contact.normal;
  contact.first_a = contact.turns_a > 0.0 ? Vec(point.point - a.position) : Vec(radius_a * n);
  contact.first_b = contact.turns_b > 0.0 ? Vec(point.point - (b.position + shift)) : Vec(-radius_b * n);
  contact.gap = point.separation - n.dot((b.position - a.position) + (contact.first_b - contact.first_a));
  contact.normal_mass = effective_mass(a, b, contact.first_a, contact.first_b, n);
  contact.tangent_mass = effective_mass(a, b, contact.first_a, contact.first_b, tangent(n));
}

}  // namespace

std::uint64_t ContactFinder::Touch::key() const {
  return key_of(pair, obstacle);
}

ContactFinder::ContactFinder(const Scene& scene, const Plan& plan)
    : scene_(scene), plan_(plan), discs_(scene, plan) {}

void ContactFinder::find(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                         Rows awake, Contacts& contacts, Workers& workers) {
  contacts.clear();
  contacts.strips.cut(bodies, awake, candidates.pairs().size() + candidates.obstacle_pairs().size(),
                      candidates.mean_radius(), workers);
  const std::span<const Pair> discs = sort_out(candidates);
  discs_.find(discs, candidates, state, bodies, contacts, workers);
  if (!touches_.empty()) {
    if (plan_.polygons) turn_shapes(state, awake, workers);
    touch(candidates, state, contacts.strips, workers);
    count_points(contacts);
    add_points(candidates, bodies, contacts, workers);
  }
  if (plan_.rolling) find_rolls(scene_, plan_, candidates, state, bodies, contacts);
}

/// Returns the pairs of discs; all others may touch.
std::span<const Pair> ContactFinder::sort_out(const Candidates& candidates) {
  const Colliders& colliders = candidates.colliders();
  touches_.clear(), disc_pairs_.clear();
  const bool all_discs = colliders.shape.empty();
  for (const Pair& pair : all_discs ? std::span<const Pair>() : candidates.pairs())
    if (is_disc(colliders, pair.a) && is_disc(colliders, pair.b))
      disc_pairs_.push_back(pair);
    else
      touches_.push_back({pair, false, candidates.shift(pair)});
  for (const Pair& pair : candidates.obstacle_pairs())
    touches_.push_back({pair, true, candidates.obstacle_shift(pair.a)});
  return all_discs ? candidates.pairs() : disc_pairs_;
}

void ContactFinder::turn_shapes(const State& state, Rows awake, Workers& workers) {
  pose_.resize(state.position.size());
  workers.for_ranges(awake.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      pose_[awake[i]] = narrowphase::pose(state.position[awake[i]], state.angle[awake[i]]);
  });
}

/// What is kept of the last step, the manifold now, and its group.
void ContactFinder::touch(const Candidates& candidates, const State& state, const Strips& strips,
                          Workers& workers) {
  const std::vector<std::uint32_t>& body = candidates.colliders().body;
  const auto nobody = static_cast<std::uint32_t>(state.position.size());
  group_.resize(touches_.size());
  workers.for_ranges(touches_.size(), [&](std::size_t begin, std::size_t end) {
    Memory memory(state.point_contacts, touches_[begin].key());
    for (std::size_t i = begin; i < end; ++i) {
      Touch& touch = touches_[i];
      touch.kept = memory.find(touch.key());
      touch.manifold = manifold(candidates, state, touch);
      group_[i] = touch.manifold.count == 0
                      ? static_cast<std::uint8_t>(strips.groups())
                      : strips.group(body[touch.pair.a], touch.obstacle ? nobody : body[touch.pair.b]);
    }
  });
}

/// Numbers the points and makes room for them.
void ContactFinder::count_points(Contacts& contacts) {
  std::uint32_t points = 0;
  for (Touch& touch : touches_) {
    touch.first_point = points;
    points += static_cast<std::uint32_t>(touch.manifold.count);
  }
  contacts.point_key.resize(points), contacts.point_feature.resize(points);
  contacts.point_bounces.resize(plan_.restitution ? points : 0);
}

/// A disc looks the same from all sides: where there is nothing else, nobody has turned.
Pose ContactFinder::pose(const State& state, std::uint32_t body) const {
  return plan_.polygons ? pose_[body] : Pose{state.position[body]};
}

Manifold ContactFinder::manifold(const Candidates& candidates, const State& state, const Touch& touch) const {
  const Colliders& colliders = candidates.colliders();
  const auto [row_a, row_b] = touch.pair;
  // A disc about its body's centre has no shape of its own: it borrows one.
  thread_local Convex disc_a = narrowphase::disc(1.0), disc_b = disc_a;
  const auto shape = [&](std::uint32_t row, Convex& disc) -> const Convex& {
    if (!is_disc(colliders, row)) return *colliders.shape[row];
    disc.radius = colliders.radius[row];
    return disc;
  };
  const Convex& a = shape(row_a, disc_a);
  const Pose pose_a = pose(state, colliders.body[row_a]);
  if (!touch.obstacle) {
    Pose pose_b = pose(state, colliders.body[row_b]);
    pose_b.position += touch.shift;
    const Convex& b = shape(row_b, disc_b);
    const double reach = candidates.reach(touch.pair);
    const Manifold m = narrowphase::manifold(a, pose_a, b, pose_b, reach, reference(touch.kept, a, b));
    return colliders.radius[row_a] >= colliders.radius[row_b]
               ? on_outline_of_a(m, {a, pose_a}, rim(colliders, row_a), {b, pose_b}, reach)
               : on_outline_of_b(m, {a, pose_a}, {b, pose_b}, rim(colliders, row_b), reach);
  }
  const Obstacles& obstacles = candidates.obstacles();
  const double reach = candidates.reach(row_a);
  const std::size_t sides = obstacles.side.size();
  if (row_b < sides) return narrowphase::manifold(a, pose_a, obstacles.side[row_b], reach);
  const Convex& part = obstacles.part[row_b - sides];
  const Pose pose_b{touch.shift};
  return on_outline_of_b(
      narrowphase::manifold(a, pose_a, part, pose_b, reach, reference(touch.kept, a, part)), {a, pose_a},
      {part, pose_b}, obstacles.rim[row_b - sides], reach);
}

/// What all points of one manifold share but the normal.
PointContact ContactFinder::point_contact(const Colliders& colliders, const Obstacles& obstacles,
                                          const Touch& touch, std::uint32_t obstacle_row) const {
  const auto [row_a, row_b] = touch.pair;
  PointContact contact;
  contact.a = colliders.body[row_a];
  contact.b = touch.obstacle ? obstacle_row : colliders.body[row_b];
  contact.turns_a = is_disc(colliders, row_a) ? 0.0 : 1.0;
  contact.turns_b = !touch.obstacle && is_disc(colliders, row_b) ? 0.0 : 1.0;
  const std::uint32_t material_b =
      touch.obstacle ? obstacles.material[row_b] : scene_.bodies.material[contact.b];
  const Surface& surface =
      plan_.surfaces[scene_.bodies.material[contact.a] * scene_.materials.size() + material_b];
  contact.friction = surface.friction, contact.restitution = surface.restitution;
  return contact;
}

void ContactFinder::add_points(const Candidates& candidates, std::span<const SolverBody> bodies,
                               Contacts& contacts, Workers& workers) {
  const Strips& strips = contacts.strips;
  of_group_.sort(group_, strips.groups() + 1, workers);
  contacts.faces.start(contacts.point_key.size(), bodies.size(), strips.groups());
  strips.for_each_group(workers, [&](std::size_t group, std::size_t phase) {
    const std::uint32_t still = still_row(bodies, group);
    contacts.faces.start_group(group, phase, still);
    for (const std::uint32_t i : of_group_[group]) {
      const Touch& touch = touches_[i];
      PointContact contact = point_contact(candidates.colliders(), candidates.obstacles(), touch, still);
      contact.normal = touch.manifold.normal;
      add_face(touch, contact, candidates.colliders(), bodies, group, contacts);
    }
    contacts.faces.group(group).finish();
  });
}

/// `contact`: what its points share.
void ContactFinder::add_face(const Touch& touch, const PointContact& contact, const Colliders& colliders,
                             std::span<const SolverBody> bodies, std::size_t group,
                             Contacts& contacts) const {
  const double radius_a = colliders.radius[touch.pair.a];
  const double radius_b = touch.obstacle ? 0.0 : colliders.radius[touch.pair.b];
  const SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
  std::array<PointContact, 2> face{contact, contact};
  const auto count = static_cast<std::uint32_t>(touch.manifold.count);
  for (std::uint32_t p = 0; p < count; ++p) {
    const ManifoldPoint& point = touch.manifold.points[p];
    place(face[p], point, a, b, touch.shift, radius_a, radius_b);
    if (const ContactImpulse* kept = recall(touch.kept, point.feature))
      face[p].normal_impulse = kept->normal, face[p].tangent_impulse = kept->tangent;
    const std::uint32_t i = touch.first_point + p;
    contacts.point_key[i] = touch.key();
    contacts.point_feature[i] = point.feature;
    if (plan_.restitution) contacts.point_bounces[i] = face[p];
  }
  const std::uint32_t seat = contacts.faces.group(group).add({face.data(), count}, a, b);
  for (std::uint32_t p = 0; p < count; ++p) contacts.faces.seat(touch.first_point + p, group, seat + p);
}

}  // namespace throng
