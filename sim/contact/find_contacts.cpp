// SPDX-License-Identifier: MIT
#include "sim/contact/find_contacts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "narrowphase/half_plane.h"
#include "sim/contact/contact_key.h"
#include "sim/contact/find_rolls.h"

namespace throng {

using broadphase::Pair;
using narrowphase::Convex;
using narrowphase::Manifold;
using narrowphase::ManifoldPoint;
using narrowphase::Pose;
using narrowphase::Reference;

namespace {

/// Seats of discs are made for pairs that are nearer than this beyond what a step asks for; where they are
/// not of use for kSeatGain steps, none are kept for so many.
constexpr double kSeatRoom = 0.02;  // of the two radii
constexpr int kSeatWait = 30;
constexpr std::size_t kFewSeats = 100;  // don't matter if they are empty

/// The contacts of the last step that pressed. They and the questions ascend by key: the search never goes
/// back.
class Memory {
 public:
  /// Keys below `first` won't be asked for.
  explicit Memory(std::span<const ContactImpulse> kept, std::uint64_t first = 0) : kept_(kept) {
    const auto below = [](const ContactImpulse& contact, std::uint64_t key) { return contact.key < key; };
    next_ = static_cast<std::size_t>(std::lower_bound(kept.begin(), kept.end(), first, below) - kept.begin());
  }

  /// The first contact under that key; null where nothing pressed.
  const ContactImpulse* find(std::uint64_t key) {
    while (next_ < kept_.size() && kept_[next_].key < key) ++next_;
    return next_ < kept_.size() && kept_[next_].key == key ? &kept_[next_] : nullptr;
  }

  void recall(std::uint64_t key, std::uint32_t feature, ContactBase& contact) {
    contact.normal_impulse = contact.tangent_impulse = 0.0;
    if (!find(key)) return;
    const std::uint32_t touch = narrowphase::without_reference(feature);
    for (std::size_t i = next_; i < kept_.size() && kept_[i].key == key; ++i)
      if (narrowphase::without_reference(kept_[i].feature) == touch) {
        contact.normal_impulse = kept_[i].normal;
        contact.tangent_impulse = kept_[i].tangent;
      }
  }

 private:
  std::span<const ContactImpulse> kept_;
  std::size_t next_;
};

/// The face that described the contact of a and b in the last step.
Reference reference(const ContactImpulse* kept, const Convex& a, const Convex& b) {
  return kept ? narrowphase::reference(kept->feature, a, b) : Reference{};
}

/// The mass that bodies a and b show to an impulse along `direction` at those arms.
double effective_mass(const SolverBody& a, const SolverBody& b, const Vec& arm_a, const Vec& arm_b,
                      const Vec& direction) {
  const double turn_a = cross(arm_a, direction), turn_b = cross(arm_b, direction);
  return 1.0 / (a.inverse_mass + b.inverse_mass + a.inverse_inertia * turn_a * turn_a +
                b.inverse_inertia * turn_b * turn_b);
}

using narrowphase::PlacedConvex;
using narrowphase::Rim;

/// What is left of the contact of a and b once one of them is a piece of its whole: a seam matters to what is
/// smaller than the part beside it.
Manifold on_outline_of_a(const Manifold& m, const PlacedConvex& a, const Rim& rim, const PlacedConvex& b,
                         double reach) {
  return rim.empty() ? m : on_outline(m, a, rim, b, reach);
}
Manifold on_outline_of_b(Manifold m, const PlacedConvex& a, const PlacedConvex& b, const Rim& rim,
                         double reach) {
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

ContactFinder::ContactFinder(const Scene& scene, const Plan& plan) : scene_(scene), plan_(plan) {}

void ContactFinder::find(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                         Rows awake, Contacts& contacts, Workers& workers) {
  contacts.start(bodies.size());
  sort_out(candidates, contacts);
  find_disc_contacts(candidates, state, bodies, contacts);
  find_touches(candidates, state, bodies, awake, contacts, workers);
  if (plan_.rolling) find_rolls(scene_, plan_, candidates, state, bodies, contacts);
}

void ContactFinder::find_touches(const Candidates& candidates, const State& state,
                                 std::span<const SolverBody> bodies, Rows awake, Contacts& contacts,
                                 Workers& workers) {
  if (touches_.empty()) return;
  manifolds_.resize(touches_.size());
  if (plan_.polygons) {
    pose_.resize(state.position.size());
    workers.for_ranges(awake.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        pose_[awake[i]] = narrowphase::pose(state.position[awake[i]], state.angle[awake[i]]);
    });
  }
  workers.for_ranges(touches_.size(), [&](std::size_t begin, std::size_t end) {
    Memory memory(state.point_contacts, touches_[begin].key());
    for (std::size_t i = begin; i < end; ++i)
      manifolds_[i] = manifold(candidates, state, touches_[i], memory.find(touches_[i].key()));
  });
  add_points(candidates, state, bodies, contacts);
}

/// Pairs of two discs have their contacts' keys then; what else there is must be looked at.
void ContactFinder::sort_out(const Candidates& candidates, Contacts& contacts) {
  const Colliders& colliders = candidates.colliders();
  touches_.clear();
  for (const Pair& pair : candidates.pairs()) {
    if (is_disc(colliders, pair.a) && is_disc(colliders, pair.b))
      contacts.disc_key.push_back(key_of(pair, false));
    else
      touches_.push_back({pair, false, candidates.shift(pair)});
  }
  for (const Pair& pair : candidates.obstacle_pairs())
    touches_.push_back({pair, true, candidates.obstacle_shift(pair.a)});
}

/// The contact of two discs about their bodies' centres; its normal is found in each substep.
DiscContact ContactFinder::disc_contact(const Colliders& colliders, Pair pair,
                                        std::span<const SolverBody> bodies) const {
  DiscContact contact;
  contact.a = colliders.body[pair.a], contact.b = colliders.body[pair.b];
  contact.radius_a = colliders.radius[pair.a], contact.radius_b = colliders.radius[pair.b];
  const std::vector<std::uint32_t>& material = scene_.bodies.material;
  const Surface& surface =
      plan_.surfaces[material[contact.a] * scene_.materials.size() + material[contact.b]];
  contact.friction = surface.friction, contact.restitution = surface.restitution;
  const SolverBody &a = bodies[contact.a], &b = bodies[contact.b];
  const double masses = a.inverse_mass + b.inverse_mass;
  contact.normal_mass = 1.0 / masses;
  contact.tangent_mass = 1.0 / (masses + a.inverse_inertia * contact.radius_a * contact.radius_a +
                                b.inverse_inertia * contact.radius_b * contact.radius_b);
  return contact;
}

void ContactFinder::find_disc_contacts(const Candidates& candidates, const State& state,
                                       std::span<const SolverBody> bodies, Contacts& contacts) {
  const bool crowded = 2 * contacts.discs.seats() <= 3 * contacts.disc_key.size() + kFewSeats;
  if (wait_ > 0 || !crowded || !contacts.discs.take(contacts.disc_key))
    seat_discs(candidates, bodies, contacts);
  ++age_;
  Memory memory(state.disc_contacts);
  ContactBase kept;
  for (std::size_t i = 0; i < contacts.disc_key.size(); ++i) {
    memory.recall(contacts.disc_key[i], 0, kept);
    contacts.discs.set_impulses(i, kept.normal_impulse, kept.tangent_impulse);
    if (!plan_.restitution) continue;
    contacts.disc_bounces.push_back(
        disc_contact(candidates.colliders(), pair_of(contacts.disc_key[i]), bodies));
  }
}

/// Seats for the discs that may touch now, and where the last ones were of use also for those that may soon.
void ContactFinder::seat_discs(const Candidates& candidates, std::span<const SolverBody> bodies,
                               Contacts& contacts) {
  const Colliders& colliders = candidates.colliders();
  if (wait_ > 0)
    --wait_;
  else if (age_ < kSeatGain)
    wait_ = kSeatWait;
  age_ = 0;
  std::span<const Pair> pairs = candidates.pairs();
  if (wait_ == 0) {
    candidates.list_near(kSeatRoom, near_);
    pairs = near_;
  }
  contacts.discs.start(bodies.size());
  for (const Pair& pair : pairs)
    if (is_disc(colliders, pair.a) && is_disc(colliders, pair.b)) {
      const DiscContact contact = disc_contact(colliders, pair, bodies);
      contacts.discs.add(key_of(pair, false), contact, bodies[contact.a], bodies[contact.b]);
    }
  contacts.discs.finish();
  [[maybe_unused]] const bool all = contacts.discs.take(contacts.disc_key);
  assert(all);
}

/// A disc looks the same from all sides: where there is nothing else, nobody has turned.
Pose ContactFinder::pose(const State& state, std::uint32_t body) const {
  return plan_.polygons ? pose_[body] : Pose{state.position[body]};
}

Manifold ContactFinder::manifold(const Candidates& candidates, const State& state, const Touch& touch,
                                 const ContactImpulse* kept) const {
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
    const Manifold m = narrowphase::manifold(a, pose_a, b, pose_b, reach, reference(kept, a, b));
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
  return on_outline_of_b(narrowphase::manifold(a, pose_a, part, pose_b, reach, reference(kept, a, part)),
                         {a, pose_a}, {part, pose_b}, obstacles.rim[row_b - sides], reach);
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

void ContactFinder::add_points(const Candidates& candidates, const State& state,
                               std::span<const SolverBody> bodies, Contacts& contacts) const {
  const Colliders& colliders = candidates.colliders();
  Memory memory(state.point_contacts);
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const Touch& touch = touches_[i];
    if (manifolds_[i].count == 0) continue;
    const std::uint64_t key = touch.key();
    PointContact contact = point_contact(colliders, candidates.obstacles(), touch,
                                         static_cast<std::uint32_t>(bodies.size() - 1));
    contact.normal = manifolds_[i].normal;
    const double radius_a = colliders.radius[touch.pair.a];
    const double radius_b = touch.obstacle ? 0.0 : colliders.radius[touch.pair.b];
    std::array<PointContact, 2> face;
    const auto count = static_cast<std::size_t>(manifolds_[i].count);
    for (std::size_t p = 0; p < count; ++p) {
      const ManifoldPoint& point = manifolds_[i].points[p];
      face[p] = contact;
      place(face[p], point, bodies[contact.a], bodies[contact.b], touch.shift, radius_a, radius_b);
      memory.recall(key, point.feature, face[p]);
      contacts.point_key.push_back(key);
      contacts.point_feature.push_back(point.feature);
      if (plan_.restitution) contacts.point_bounces.push_back(face[p]);
    }
    contacts.faces.add({face.data(), count}, bodies[contact.a], bodies[contact.b]);
  }
  contacts.faces.finish();
}

void Contacts::start(std::size_t bodies) {
  discs.clear(), disc_key.clear(), disc_bounces.clear();
  faces.start(bodies), point_key.clear(), point_feature.clear(), point_bounces.clear();
  disc_rolls.clear(), point_rolls.clear();
}

void Contacts::save(State& state) const {
  state.disc_contacts.clear(), state.point_contacts.clear();
  for (std::size_t i = 0; i < discs.size(); ++i)
    if (const double normal = discs.normal_impulse(i); normal > 0.0)
      state.disc_contacts.push_back({disc_key[i], 0, normal, discs.tangent_impulse(i)});
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (const double normal = faces.normal_impulse(i); normal > 0.0)
      state.point_contacts.push_back({point_key[i], point_feature[i], normal, faces.tangent_impulse(i)});
  save_rolls(discs, disc_rolls, state.disc_contacts);
  save_rolls(faces, point_rolls, state.point_contacts);
}

}  // namespace throng
