// SPDX-License-Identifier: MIT
#include "sim/contact/find_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "narrowphase/half_plane.h"
#include "sim/contact/arms.h"
#include "sim/contact/contact_key.h"
#include "sim/contact/fast.h"
#include "sim/contact/find_rolls.h"
#include "sim/contact/kept_impulses.h"

namespace throng {

using broadphase::Pair;
using narrowphase::Convex;
using narrowphase::Manifold;
using narrowphase::ManifoldPoint;
using narrowphase::Pose;
using narrowphase::Reference;

namespace {

/// The face that described the contact of a and b in the last step.
Reference reference(const ContactImpulse* kept, const Convex& a, const Convex& b) {
  return kept ? narrowphase::reference(kept->feature, a, b) : Reference{};
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

/// m, the radius of a disc; 0 for a polygon.
double rounding(const Colliders& colliders, std::uint32_t row) {
  return is_disc(colliders, row) ? colliders.radius[row] : colliders.shape[row]->radius;
}

const Rim& rim(const Colliders& colliders, std::uint32_t row) {
  static const Rim alone;
  return colliders.rim.empty() ? alone : colliders.rims[colliders.rim[row]];
}

/// Fills in what one point of a manifold adds. The point is midway between the surfaces: `own` puts it on
/// those of the bodies, as it turns with neither where they are far apart.
void place(PointContact& contact, const ManifoldPoint& point, const SolverBody& a, const SolverBody& b,
           const Vec& shift, bool about_a, bool about_b, bool own) {
  const Vec& n = contact.normal;
  const double half = 0.5 * point.separation;
  const Vec to_a = point.point - a.position, to_b = point.point - (b.position + shift);
  const bool round_a = own || contact.round_a > 0.0, round_b = own || contact.round_b > 0.0;
  contact.first_a = about_a ? Vec(0.0, 0.0) : round_a ? Vec(to_a - (contact.round_a + half) * n) : to_a;
  contact.first_b = about_b ? Vec(0.0, 0.0) : round_b ? Vec(to_b + (contact.round_b + half) * n) : to_b;
  contact.arm_a = contact.first_a + contact.round_a * n,
  contact.arm_b = contact.first_b - contact.round_b * n;
  contact.gap = point.separation - n.dot((b.position - a.position) + (contact.arm_b - contact.arm_a));
  contact.normal_mass = effective_mass(a, b, contact.arm_a, contact.arm_b, n);
  contact.tangent_mass = effective_mass(a, b, contact.arm_a, contact.arm_b, tangent(n));
}

SolverBody moved(SolverBody body, const Vec& to) {
  body.position = to;
  return body;
}

/// What turns of the arms of a contact that was found when its bodies had turned by so much (rad), as they
/// begin.
void turn_back(PointContact& contact, double turn_a, double turn_b) {
  contact.first_a = Turn(-turn_a)(contact.first_a);
  contact.first_b = Turn(-turn_b)(contact.first_b);
}

double least_radius(const Colliders& colliders) {
  const auto least = std::ranges::min_element(colliders.radius);
  return least == colliders.radius.end() ? std::numeric_limits<double>::infinity() : *least;
}

}  // namespace

std::uint64_t ContactFinder::Touch::key() const {
  return key_of(pair, obstacle);
}

ContactFinder::ContactFinder(const Scene& scene, const Plan& plan, const Colliders& colliders)
    : scene_(scene),
      plan_(plan),
      hit_speed_(throng::hit_speed(scene, plan)),
      slow_way_(kAheadWay * least_radius(colliders)),
      parts_(scene, plan),
      discs_(scene, plan) {}

void ContactFinder::find(const Candidates& candidates, const State& state, std::span<const SolverBody> bodies,
                         Contacts& contacts, Workers& workers) {
  contacts.start(bodies.size(), parts_.groups());
  sort_out(candidates, contacts);
  const bool moved = std::exchange(moved_, false);
  discs_.find(candidates, state, bodies, parts_, moved, contacts.disc_key, contacts.discs);
  if (plan_.restitution)
    for (const std::uint64_t key : contacts.disc_key)
      contacts.disc_bounces.push_back(discs_.contact_of(candidates.colliders(), pair_of(key), bodies));
  find_touches(candidates, state, bodies, moved, contacts, workers);
  if (plan_.rolling) find_rolls(scene_, plan_, candidates, state, bodies, contacts);
}

void ContactFinder::find_touches(const Candidates& candidates, const State& state,
                                 std::span<const SolverBody> bodies, bool moved, Contacts& contacts,
                                 Workers& workers) {
  FaceBlocks& faces = contacts.faces;
  if (touches_.empty() && faces.lanes() == 0) return;
  const bool held = std::exchange(holds_, plan_.polygons && !plan_.restitution && is_worth_holding());
  if (holds_ != held) book_.forget_all(), held_.forget_all();
  if (holds_ && may_be_held_.empty()) find_who_may_be_held(candidates.colliders());
  name_lanes(faces);
  if (holds_) ask_held(candidates, state, bodies, workers), answer_held(faces, workers);
  search(candidates, state, bodies, workers);
  ++age_;
  if (moved || holds_ != held || !all_sit_well(candidates.colliders(), faces)) {
    seat_anew(candidates.colliders(), bodies.size(), faces, workers);
    if (holds_) answer_held(faces, workers);
    age_ = 0;
  } else {
    for (const std::uint32_t block : held_again_)
      held_.answer(block, block + 1, placed_, slow(), faces.all_blocks());
  }
  take_seats(faces);
  fill_faces(candidates, state, bodies, contacts, workers);
  if (!plan_.restitution) list_hits(candidates, bodies, contacts.point_bounces);
}

void ContactFinder::search(const Candidates& candidates, const State& state,
                           std::span<const SolverBody> bodies, Workers& workers) {
  manifolds_.resize(touches_.size()), points_.resize(touches_.size());
  nears_.assign(touches_.size(), 0);
  workers.for_ranges(touches_.size(), [&](std::size_t begin, std::size_t end) {
    if (begin == end) return;
    KeptImpulses memory(state.point_contacts, touches_[begin].key());
    for (std::size_t i = begin; i < end; ++i) {
      if (is_known(touches_[i])) {
        points_[i] = held_.points(touches_[i].lane);
        continue;
      }
      manifolds_[i] = manifold(candidates, touches_[i], poses(candidates, state, touches_[i]),
                               memory.find(touches_[i].key()));
      points_[i] = static_cast<std::uint8_t>(manifolds_[i].count);
      nears_[i] = nears_fast(candidates.colliders(), bodies, i);
      if (!touches_[i].held) continue;
      held_.ask_nothing(touches_[i].lane);  // of what is held from now on
      hold(candidates, state, bodies, i);
    }
  });
  look_ahead(candidates, state, bodies, workers);
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

ContactFinder::TouchPoses ContactFinder::poses(const Candidates& candidates, const State& state,
                                               const Touch& touch) const {
  const Colliders& colliders = candidates.colliders();
  const Pose pose_a = candidates.pose(state, colliders.body[touch.pair.a]);
  if (touch.obstacle) return {pose_a, Pose{touch.shift}};
  Pose pose_b = candidates.pose(state, colliders.body[touch.pair.b]);
  pose_b.position += touch.shift;
  return {pose_a, pose_b};
}

Manifold ContactFinder::manifold(const Candidates& candidates, const Touch& touch, const TouchPoses& poses,
                                 const ContactImpulse* kept) const {
  const Colliders& colliders = candidates.colliders();
  const auto [row_a, row_b] = touch.pair;
  const auto& [pose_a, pose_b] = poses;
  thread_local Convex disc_a = narrowphase::disc(1.0), disc_b = disc_a;
  const Convex& a = shape(colliders, row_a, disc_a);
  if (!touch.obstacle) {
    const Convex& b = shape(colliders, row_b, disc_b);
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
  return on_outline_of_b(narrowphase::manifold(a, pose_a, part, pose_b, reach, reference(kept, a, part)),
                         {a, pose_a}, {part, pose_b}, obstacles.rim[row_b - sides], reach);
}

/// Sets what all points of one manifold share. Number after number: to copy it from one point to the other
/// would wait until all that was written before has left the processor.
void ContactFinder::describe(const Colliders& colliders, const Obstacles& obstacles, const Touch& touch,
                             const Vec& normal, PointContact& contact) const {
  const auto [row_a, row_b] = touch.pair;
  contact.normal = normal;
  contact.a = colliders.body[row_a], contact.b = other_row(colliders, touch);
  contact.round_a = rounding(colliders, row_a);
  contact.round_b = touch.obstacle ? 0.0 : rounding(colliders, row_b);
  const Surface& surface = this->surface(
      contact.a, touch.obstacle ? obstacles.material[row_b] : scene_.bodies.material[contact.b]);
  contact.friction = surface.friction;
  contact.restitution = surface.restitution;
}

const Surface& ContactFinder::surface(std::uint32_t body, std::uint32_t other_material) const {
  return plan_.surfaces[scene_.bodies.material[body] * scene_.materials.size() + other_material];
}

/// m/s, how fast any point that the collider may reach in the step moves at most, as part of its body.
double ContactFinder::pace(const Candidates& candidates, std::span<const SolverBody> bodies,
                           std::uint32_t collider) const {
  const Colliders& colliders = candidates.colliders();
  const SolverBody& body = bodies[colliders.body[collider]];
  const double centre = colliders.centre.empty() ? 0.0 : colliders.centre[collider].norm();
  const double arm = centre + colliders.radius[collider] + candidates.reach(collider);
  return body.velocity.norm() + std::abs(body.spin) * arm;
}

/// Whether a point of the face comes nearer so fast that a sweep wouldn't do.
bool ContactFinder::hits(std::span<const PointContact> face, std::span<const SolverBody> bodies) const {
  const SolverBody &a = bodies[face[0].a], &b = bodies[face[0].b];
  return std::ranges::any_of(
      face, [&](const PointContact& c) { return arms(c).normal_velocity(a, b) < -hit_speed_; });
}

/// The body that the touch's first one meets, or the row that stands for all obstacles.
std::uint32_t ContactFinder::other_row(const Colliders& colliders, const Touch& touch) const {
  const auto [row_a, row_b] = touch.pair;
  return touch.obstacle
             ? static_cast<std::uint32_t>(scene_.bodies.size() + parts_.group(colliders.body[row_a]))
             : colliders.body[row_b];
}

std::size_t ContactFinder::group_of(const Colliders& colliders, const Touch& touch) const {
  const std::uint32_t a = colliders.body[touch.pair.a];
  return touch.obstacle ? parts_.group(a) : parts_.group(a, colliders.body[touch.pair.b]);
}

/// The points of a touch's manifold, without impulses.
std::span<PointContact> ContactFinder::face(const Candidates& candidates, std::span<const SolverBody> bodies,
                                            std::size_t touch, std::array<PointContact, 2>& points) const {
  const Colliders& colliders = candidates.colliders();
  const auto& [pair, obstacle, shift, held, lane] = touches_[touch];
  const Manifold& m = manifolds_[touch];
  const bool about_a = is_disc(colliders, pair.a), about_b = !obstacle && is_disc(colliders, pair.b);
  const auto count = static_cast<std::size_t>(m.count);
  const Meeting* meeting = ahead(touch);
  for (std::size_t p = 0; p < count; ++p) {
    describe(colliders, candidates.obstacles(), touches_[touch], m.normal, points[p]);
    const SolverBody &a = bodies[points[p].a], &b = bodies[points[p].b];
    if (meeting)
      place(points[p], m.points[p], moved(a, meeting->at_a), moved(b, meeting->at_b), shift, about_a, about_b,
            true);
    else
      place(points[p], m.points[p], a, b, shift, about_a, about_b, false);
  }
  const std::span<PointContact> face(points.data(), count);
  points[0].hits = points[1].hits = count == 2 && !(points[0].restitution > 0.0) && hits(face, bodies);
  if (meeting)
    for (PointContact& contact : face)
      turn_back(contact, meeting->when * bodies[contact.a].spin, meeting->when * bodies[contact.b].spin);
  return face;
}

void ContactFinder::fill_faces(const Candidates& candidates, const State& state,
                               std::span<const SolverBody> bodies, Contacts& contacts, Workers& workers) {
  const std::size_t size = contacts.faces.size();
  contacts.point_key.resize(size), contacts.point_feature.resize(size);
  if (plan_.restitution) contacts.point_bounces.resize(size);
  hits_.assign(touches_.size(), 0);
  workers.for_ranges(touches_.size(), [&](std::size_t begin, std::size_t end) {
    if (begin == end) return;
    KeptImpulses memory(state.point_contacts, touches_[begin].key());
    std::array<PointContact, 2> points;  // here, as to make it takes longer than to fill it
    for (std::size_t i = begin; i < end; ++i) {
      fetch_held(i, end, contacts.faces);
      if (points_[i] == 0) continue;
      if (is_known(touches_[i]))
        fill_held(i, memory, contacts);
      else
        fill_searched(candidates, bodies, i, memory, points, contacts);
    }
  });
}

/// The keys and features under which the touch's points are kept.
std::span<std::uint32_t> ContactFinder::names(std::size_t touch, Contacts& contacts) const {
  const std::size_t first = first_point_[touch];
  std::fill_n(contacts.point_key.begin() + static_cast<std::ptrdiff_t>(first), points_[touch],
              touches_[touch].key());
  return std::span(contacts.point_feature).subspan(first, points_[touch]);
}

void ContactFinder::fill_searched(const Candidates& candidates, std::span<const SolverBody> bodies,
                                  std::size_t touch, KeptImpulses& memory,
                                  std::array<PointContact, 2>& points, Contacts& contacts) {
  const std::span<PointContact> face = this->face(candidates, bodies, touch, points);
  const std::span<std::uint32_t> features = names(touch, contacts);
  for (std::size_t p = 0; p < face.size(); ++p) features[p] = manifolds_[touch].points[p].feature;
  for (std::size_t p = 0; p < face.size(); ++p) {
    const ContactImpulse* kept = memory.find(touches_[touch].key(), features, p);
    face[p].normal_impulse = kept ? kept->normal : 0.0;
    face[p].tangent_impulse = kept ? kept->tangent : 0.0;
    face[p].preload = kept ? kept->preload : 0.0;
  }
  contacts.faces.fill(first_point_[touch], face);
  if (plan_.restitution) std::ranges::copy(face, contacts.point_bounces.begin() + first_point_[touch]);
  hits_[touch] = face[0].hits;
}

/// Faces that hit, where no surface bounces.
void ContactFinder::list_hits(const Candidates& candidates, std::span<const SolverBody> bodies,
                              std::vector<PointContact>& bounces) const {
  if (std::ranges::find(hits_, 1) == hits_.end()) return;
  std::array<PointContact, 2> points;
  for (auto hit = hits_.begin(); (hit = std::find(hit, hits_.end(), 1)) != hits_.end(); ++hit) {
    const auto face = this->face(candidates, bodies, static_cast<std::size_t>(hit - hits_.begin()), points);
    bounces.insert(bounces.end(), face.begin(), face.end());
  }
}

void Contacts::start(std::size_t bodies, std::size_t groups) {
  discs.groups() == groups ? discs.clear() : discs.start(bodies, groups);
  disc_key.clear(), disc_bounces.clear();
  faces.groups() == groups ? faces.clear() : faces.start(bodies, groups);
  point_key.clear(), point_feature.clear(), point_bounces.clear();
  disc_rolls.clear(), point_rolls.clear();
}

void Contacts::save(State& state) const {
  state.disc_contacts.clear(), state.point_contacts.clear();
  for (std::size_t i = 0; i < discs.size(); ++i)
    if (const auto [normal, tangent, preload] = discs.impulses(i); normal > 0.0)
      state.disc_contacts.push_back({disc_key[i], 0, normal, tangent, 0.0, preload});
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (const auto [normal, tangent, preload] = faces.impulses(i); normal > 0.0)
      state.point_contacts.push_back({point_key[i], point_feature[i], normal, tangent, 0.0, preload});
  save_rolls(discs, disc_rolls, state.disc_contacts);
  save_rolls(faces, point_rolls, state.point_contacts);
}

}  // namespace throng
