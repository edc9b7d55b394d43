// SPDX-License-Identifier: MIT
// What hits where nothing bounces. One sweep would leave some of the speed to two points at which a body
// lands, or to who is behind the one that is hit, and impulses to be let go again: so it is stopped before
// the sweeps, as what bounces is, together with all who hang together with the two by contacts. A body that
// hits at a single point, and touches nothing else, is stopped by one sweep, however fast; one that hits at
// two, or hits two others, isn't.
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "sim/contact/find_contacts.h"
#include "sim/contact/kept_impulses.h"

namespace throng {

namespace {

/// m, and 0 where nothing resists rolling; of rolls that ascend.
double lever(std::span<const RollContact> rolls, std::size_t contact) {
  const auto at = std::ranges::lower_bound(rolls, contact, {}, &RollContact::contact);
  return at != rolls.end() && at->contact == contact ? at->lever : 0.0;
}

}  // namespace

/// Of two discs about their bodies' centres.
ContactFinder::Nearness ContactFinder::nearness(const StepStart& start, std::uint64_t disc_key) const {
  const broadphase::Pair pair = pair_of(disc_key);
  const SolverBody &a = start.bodies[colliders_.body[pair.a]], &b = start.bodies[colliders_.body[pair.b]];
  const Vec way = b.position + start.candidates.shift(pair) - a.position;
  const double distance = way.norm(), gap = distance - colliders_.radius[pair.a] - colliders_.radius[pair.b];
  const double from_a = way.dot(a.velocity) / distance, from_b = -way.dot(b.velocity) / distance;
  const double speed = from_a + from_b, dt = scene_.time.dt;
  if (speed > hit_speed_ && (speed + fall_) * dt > gap) return Nearness::hits;
  return gap < std::max(least_way(), std::max(from_a, from_b) * dt) ? Nearness::near : Nearness::apart;
}

/// The manifold of a touch that is known without a search, as a search finds it: a run that goes on from a
/// checkpoint knows none. `memory` of touches that ascend.
void ContactFinder::search_known(const StepStart& start, std::size_t touch, KeptImpulses& memory) {
  const Touch& one = touches_[touch];
  if (!is_known(one)) return;
  const TouchPoses poses = touch_poses(start, one);
  manifolds_[touch] = touch_manifold(start.candidates, one, poses, memory.find(one.key()));
}

/// Of a touch, see Cluster: of a single point at which somebody hits, or which is still far, nothing.
std::uint32_t ContactFinder::weight(const StepStart& start, std::size_t touch, KeptImpulses& memory) {
  if (points_[touch] == 2) return 2;
  if (hits_[touch] != 0) return 0;
  search_known(start, touch, memory);
  return manifolds_[touch].points[0].separation < least_way() ? 2 : 0;
}

/// Lists which discs touch, or come to if one of them is stopped. False where none of them hits another.
bool ContactFinder::find_disc_meetings(const StepStart& start, std::span<const std::uint64_t> disc_keys) {
  bool any = false;
  for (std::size_t i = 0; i < disc_keys.size(); ++i) {
    const Nearness nearness = this->nearness(start, disc_keys[i]);
    if (nearness == Nearness::apart) continue;
    const broadphase::Pair pair = pair_of(disc_keys[i]);
    const bool hits = nearness == Nearness::hits;
    meetings_.push_back({colliders_.body[pair.a], colliders_.body[pair.b], i, true, hits, hits ? 1u : 2u});
    any |= hits;
  }
  return any;
}

/// Lists who meet. False where nobody hits anybody.
bool ContactFinder::find_meetings(const StepStart& start, std::span<const std::uint64_t> disc_keys) {
  meetings_.clear();
  const bool touches_hit = std::ranges::find(hits_, 1) != hits_.end();
  if (!touches_hit && 2.0 * start.candidates.chain() <= hit_speed_ * scene_.time.dt) return false;
  if (!find_disc_meetings(start, disc_keys) && !touches_hit) return false;
  KeptImpulses memory(start.state.point_contacts);
  for (std::size_t i = 0; i < touches_.size(); ++i)
    if (points_[i] > 0)
      meetings_.push_back({touches_[i].a, touches_[i].b, i, false, hits_[i] != 0, weight(start, i, memory)});
  return true;
}

bool ContactFinder::both_move(const Meeting& meeting, BodyRows<const SolverBody> bodies) {
  return bodies[meeting.a].is_dynamic() && bodies[meeting.b].is_dynamic();
}

/// Of who hang together by meetings.
void ContactFinder::find_clusters(BodyRows<const SolverBody> bodies) {
  islands_.start(Rows::all(bodies.size()), bodies.size()), clusters_.assign(bodies.size(), {});
  for (const Meeting& meeting : meetings_)
    if (both_move(meeting, bodies)) islands_.join(meeting.a, meeting.b);
  for (const Meeting& meeting : meetings_) {
    Cluster& cluster = cluster_of(meeting, bodies);
    ++cluster.meetings, cluster.weight += meeting.weight;
    cluster.hit |= meeting.hits;
  }
}

ContactFinder::Cluster& ContactFinder::cluster_of(const Meeting& meeting, BodyRows<const SolverBody> bodies) {
  return clusters_[islands_.first(bodies[meeting.a].is_dynamic() ? meeting.a : meeting.b)];
}

/// Where a surface bounces, all contacts are listed anyway: these are told of hits.
void ContactFinder::list_hits(const StepStart& start, Contacts& contacts) {
  if (!find_meetings(start, contacts.disc_key)) return;
  find_clusters(start.bodies);
  KeptImpulses memory(start.state.point_contacts);
  for (const Meeting& meeting : meetings_) {
    const Cluster& cluster = cluster_of(meeting, start.bodies);
    if (!cluster.is_stopped()) continue;
    contacts.hits += meeting.discs ? 1 : points_[meeting.contact];
    if (meeting.discs)
      list_disc(start, meeting.contact, contacts);
    else
      list_touch(start, meeting.contact, memory, contacts);
  }
}

void ContactFinder::list_disc(const StepStart& start, std::size_t contact, Contacts& contacts) const {
  std::vector<DiscContact>& bounces = contacts.disc_bounces;
  if (plan_.restitution) return void(bounces[contact].hits = true);
  bounces.push_back(discs_.contact_of(colliders_, pair_of(contacts.disc_key[contact]), start.bodies));
  bounces.back().row = static_cast<std::uint32_t>(contact);
  bounces.back().hits = true, bounces.back().lever = lever(contacts.disc_rolls, contact);
}

void ContactFinder::list_touch(const StepStart& start, std::size_t touch, KeptImpulses& memory,
                               Contacts& contacts) {
  std::vector<PointContact>& bounces = contacts.point_bounces;
  std::size_t row = first_point_[touch];
  if (plan_.restitution) {
    for (std::size_t end = row + points_[touch]; row < end; ++row) bounces[row].hits = true;
    return;
  }
  search_known(start, touch, memory);
  assert(manifolds_[touch].count == points_[touch]);
  std::array<PointContact, 2> points;
  for (const PointContact& point : face(start, touch, points)) {
    bounces.push_back(point);
    bounces.back().row = static_cast<std::uint32_t>(row);
    bounces.back().hits = true, bounces.back().lever = lever(contacts.point_rolls, row++);
  }
}

}  // namespace throng
