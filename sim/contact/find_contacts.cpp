// SPDX-License-Identifier: MIT
#include "sim/contact/find_contacts.h"

#include <cmath>

#include "narrowphase/half_plane.h"

namespace throng {

using broadphase::Pair;
using narrowphase::Convex;
using narrowphase::Manifold;
using narrowphase::ManifoldPoint;
using narrowphase::Pose;

namespace {

constexpr std::uint64_t kObstacle = std::uint64_t{1} << 63;  // keys of obstacles come after those of pairs

std::uint64_t key_of(Pair pair, bool obstacle) {
  return (obstacle ? kObstacle : 0) | std::uint64_t{pair.a} << 32 | pair.b;
}

double cross(const Vec& a, const Vec& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Vec tangent(const Vec& normal) {
  return {-normal.y(), normal.x()};
}

/// The impulses of the last step. Both run in ascending order of key, so the search never goes back.
class Memory {
 public:
  explicit Memory(std::span<const ContactImpulse> kept) : kept_(kept) {}

  void recall(std::uint64_t key, std::uint32_t feature, ContactBase& contact) {
    contact.normal_impulse = contact.tangent_impulse = 0.0;
    while (next_ < kept_.size() && kept_[next_].key < key) ++next_;
    for (std::size_t i = next_; i < kept_.size() && kept_[i].key == key; ++i)
      if (kept_[i].feature == feature) {
        contact.normal_impulse = kept_[i].normal;
        contact.tangent_impulse = kept_[i].tangent;
      }
  }

 private:
  std::span<const ContactImpulse> kept_;
  std::size_t next_ = 0;
};

/// The mass that bodies a and b show to an impulse along `direction` at those arms.
double effective_mass(const SolverBody& a, const SolverBody& b, const Vec& arm_a, const Vec& arm_b,
                      const Vec& direction) {
  const double turn_a = cross(arm_a, direction), turn_b = cross(arm_b, direction);
  return 1.0 / (a.inverse_mass + b.inverse_mass + a.inverse_inertia * turn_a * turn_a +
                b.inverse_inertia * turn_b * turn_b);
}

bool is_disc(const Colliders& colliders, std::uint32_t row) {
  return colliders.shape.empty() || !colliders.shape[row];
}

DiscContact disc_contact(const Colliders& colliders, Pair pair, std::span<const SolverBody> bodies,
                         Surface surface) {
  DiscContact contact;
  contact.a = colliders.body[pair.a], contact.b = colliders.body[pair.b];
  contact.radius_a = colliders.radius[pair.a], contact.radius_b = colliders.radius[pair.b];
  contact.friction = surface.friction, contact.restitution = surface.restitution;
  const SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
  const double masses = a.inverse_mass + b.inverse_mass;
  contact.normal_mass = 1.0 / masses;
  contact.tangent_mass = 1.0 / (masses + a.inverse_inertia * contact.radius_a * contact.radius_a +
                                b.inverse_inertia * contact.radius_b * contact.radius_b);
  return contact;
}

}  // namespace

ContactFinder::ContactFinder(const Scene& scene, const Plan& plan) : scene_(scene), plan_(plan) {}

void ContactFinder::find(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                         Contacts& contacts, Workers& workers) {
  sort_out(candidates, state, bodies, contacts);
  if (slots_.empty() && contacts.points.empty()) return;
  pose_.resize(state.position.size());
  workers.for_ranges(pose_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) pose_[i] = narrowphase::pose(state.position[i], state.angle[i]);
  });
  workers.for_ranges(slots_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) find_manifold(candidates, slots_[i]);
  });
  add_points(candidates, state, bodies, contacts);
}

void ContactFinder::sort_out(const Candidates& candidates, const State& state,
                             std::span<const SolverBody> bodies, Contacts& contacts) {
  const Colliders& colliders = candidates.colliders();
  Memory memory(state.disc_contacts);
  contacts.discs.clear(), contacts.disc_key.clear(), slots_.clear();
  for (const Pair& pair : candidates.pairs()) {
    if (!is_disc(colliders, pair.a) || !is_disc(colliders, pair.b)) {
      slots_.push_back({pair, false, candidates.shift(pair), {}});
      continue;
    }
    const std::size_t materials = scene_.materials.size();
    const auto material = [&](std::uint32_t row) { return scene_.bodies.material[colliders.body[row]]; };
    DiscContact contact = disc_contact(colliders, pair, bodies,
                                       plan_.surfaces[material(pair.a) * materials + material(pair.b)]);
    contacts.disc_key.push_back(key_of(pair, false));
    memory.recall(contacts.disc_key.back(), 0, contact);
    contacts.discs.push_back(contact);
  }
  for (const Pair& pair : candidates.obstacle_pairs()) slots_.push_back({pair, true, Vec(0.0, 0.0), {}});
}

void ContactFinder::find_manifold(const Candidates& candidates, Slot& slot) const {
  const Colliders& colliders = candidates.colliders();
  const auto [row_a, row_b] = slot.pair;
  // A disc about its body's centre has no shape of its own: it borrows one.
  thread_local Convex disc_a = narrowphase::disc(1.0), disc_b = disc_a;
  const auto shape = [&](std::uint32_t row, Convex& disc) -> const Convex& {
    if (!is_disc(colliders, row)) return *colliders.shape[row];
    disc.radius = colliders.radius[row];
    return disc;
  };
  const Convex& a = shape(row_a, disc_a);
  const Pose& pose_a = pose_[colliders.body[row_a]];
  if (!slot.obstacle) {
    Pose pose_b = pose_[colliders.body[row_b]];
    pose_b.position += slot.shift;
    slot.manifold =
        narrowphase::manifold(a, pose_a, shape(row_b, disc_b), pose_b, candidates.reach(slot.pair));
    return;
  }
  const Obstacles& obstacles = candidates.obstacles();
  const std::size_t sides = obstacles.side.size();
  if (row_b < sides)
    slot.manifold = narrowphase::manifold(a, pose_a, obstacles.side[row_b], candidates.reach(row_a));
  else
    slot.manifold =
        narrowphase::manifold(a, pose_a, obstacles.part[row_b - sides], Pose{}, candidates.reach(row_a));
}

void ContactFinder::add_points(const Candidates& candidates, const State& state,
                               std::span<const SolverBody> bodies, Contacts& contacts) const {
  const Colliders& colliders = candidates.colliders();
  Memory memory(state.point_contacts);
  contacts.points.clear(), contacts.point_key.clear(), contacts.point_feature.clear();
  const auto obstacle_row = static_cast<std::uint32_t>(bodies.size() - 1);
  for (const Slot& slot : slots_) {
    const Manifold& manifold = slot.manifold;
    const auto [row_a, row_b] = slot.pair;
    const bool disc_a = is_disc(colliders, row_a), disc_b = !slot.obstacle && is_disc(colliders, row_b);
    PointContact contact;
    contact.a = colliders.body[row_a];
    contact.b = slot.obstacle ? obstacle_row : colliders.body[row_b];
    const SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
    const std::uint32_t material_b =
        slot.obstacle ? candidates.obstacles().material[row_b] : scene_.bodies.material[contact.b];
    const Surface surface =
        plan_.surfaces[scene_.bodies.material[contact.a] * scene_.materials.size() + material_b];
    contact.friction = surface.friction, contact.restitution = surface.restitution;
    contact.normal = manifold.normal;
    contact.turns_a = disc_a ? 0.0 : 1.0, contact.turns_b = disc_b ? 0.0 : 1.0;
    for (int i = 0; i < manifold.count; ++i) {
      const ManifoldPoint& point = manifold.points[static_cast<std::size_t>(i)];
      const Vec position_b = b.position + slot.shift;
      contact.first_a =
          disc_a ? Vec(colliders.radius[row_a] * manifold.normal) : Vec(point.point - a.position);
      contact.first_b =
          disc_b ? Vec(-colliders.radius[row_b] * manifold.normal) : Vec(point.point - position_b);
      contact.gap = point.separation -
                    manifold.normal.dot((b.position - a.position) + (contact.first_b - contact.first_a));
      contact.normal_mass = effective_mass(a, b, contact.first_a, contact.first_b, manifold.normal);
      contact.tangent_mass = effective_mass(a, b, contact.first_a, contact.first_b, tangent(manifold.normal));
      contacts.point_key.push_back(key_of(slot.pair, slot.obstacle));
      contacts.point_feature.push_back(point.feature);
      memory.recall(contacts.point_key.back(), point.feature, contact);
      contacts.points.push_back(contact);
    }
  }
}

void Contacts::save(State& state) const {
  state.disc_contacts.clear(), state.point_contacts.clear();
  for (std::size_t i = 0; i < discs.size(); ++i)
    if (discs[i].normal_impulse > 0.0)
      state.disc_contacts.push_back({disc_key[i], 0, discs[i].normal_impulse, discs[i].tangent_impulse});
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].normal_impulse > 0.0)
      state.point_contacts.push_back(
          {point_key[i], point_feature[i], points[i].normal_impulse, points[i].tangent_impulse});
}

}  // namespace throng
