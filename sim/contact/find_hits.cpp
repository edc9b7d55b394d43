// SPDX-License-Identifier: MIT
// What hits where nothing bounces. One sweep would leave some of the speed to two points at which a body
// lands, or to who is behind the one that is hit, and impulses to be let go again: so it is stopped before
// the sweeps, as what bounces is, together with all that touches the two. A body that hits at a single point,
// and touches nothing else, is stopped by one sweep, however fast.
#include <algorithm>
#include <array>
#include <cstddef>

#include "sim/contact/find_contacts.h"

namespace throng {

namespace {

/// m, and 0 where nothing resists rolling; of rolls that ascend.
double lever(std::span<const RollContact> rolls, std::size_t contact) {
  const auto at = std::ranges::lower_bound(rolls, contact, {}, &RollContact::contact);
  return at != rolls.end() && at->contact == contact ? at->lever : 0.0;
}

}  // namespace

/// Whether two discs about their bodies' centres hit each other in this step, or are near each other at
/// least.
ContactFinder::Nearness ContactFinder::nearness(const StepStart& start, std::uint64_t disc_key) const {
  const broadphase::Pair pair = pair_of(disc_key);
  const SolverBody &a = start.bodies[colliders_.body[pair.a]], &b = start.bodies[colliders_.body[pair.b]];
  const Vec way = b.position + start.candidates.shift(pair) - a.position;
  const double distance = way.norm(), speed = -way.dot(b.velocity - a.velocity) / distance;
  const double gap = distance - colliders_.radius[pair.a] - colliders_.radius[pair.b];
  if (speed > hit_speed_ && speed * scene_.time.dt > gap) return Nearness::hits;
  return gap < least_way() ? Nearness::near : Nearness::apart;
}

/// Marks who hits somebody in this step. False where nobody does.
bool ContactFinder::find_who_hits(const StepStart& start, std::span<const std::uint64_t> disc_keys) {
  const bool fast = 2.0 * start.candidates.chain() > hit_speed_ * scene_.time.dt;
  if (!fast && std::ranges::find(hits_, 1) == hits_.end()) return false;
  struck_.assign(start.bodies.size(), 0), nearness_.resize(disc_keys.size());
  bool any = false;
  const auto mark = [&](std::uint32_t row) {
    if (start.bodies[row].inverse_mass > 0.0) struck_[row] = 1, any = true;
  };
  for (std::size_t i = 0; i < hits_.size(); ++i)
    if (hits_[i] != 0) mark(touches_[i].a), mark(touches_[i].b);
  for (std::size_t i = 0; i < disc_keys.size(); ++i) {
    nearness_[i] = nearness(start, disc_keys[i]);
    if (nearness_[i] != Nearness::hits) continue;
    const broadphase::Pair pair = pair_of(disc_keys[i]);
    mark(colliders_.body[pair.a]), mark(colliders_.body[pair.b]);
  }
  return any;
}

/// Of who hits, beginning with 1: more than 2 where he hits two discs, meets a face or rests on something.
void ContactFinder::count_touches(std::span<const std::uint64_t> disc_keys) {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t more) {
    if (struck_[a] > 0) struck_[a] += more;
    if (struck_[b] > 0) struck_[b] += more;
  };
  for (std::size_t i = 0; i < disc_keys.size(); ++i) {
    const broadphase::Pair pair = pair_of(disc_keys[i]);
    if (nearness_[i] != Nearness::apart)
      add(colliders_.body[pair.a], colliders_.body[pair.b], nearness_[i] == Nearness::hits ? 1 : 2);
  }
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const bool rests = points_[i] == 1 && hits_[i] == 0 &&
                       (is_known(touches_[i]) || manifolds_[i].points[0].separation < least_way());
    if (points_[i] == 2 || rests) add(touches_[i].a, touches_[i].b, 2);
  }
}

/// Where a surface bounces, all contacts are listed anyway: these are told of hits.
void ContactFinder::list_hits(const StepStart& start, Contacts& contacts) {
  if (!find_who_hits(start, contacts.disc_key)) return;
  count_touches(contacts.disc_key);
  const auto are_hit = [&](std::uint32_t a, std::uint32_t b) { return struck_[a] > 2 || struck_[b] > 2; };
  for (std::size_t i = 0; i < contacts.disc_key.size(); ++i) {
    const broadphase::Pair pair = pair_of(contacts.disc_key[i]);
    if (are_hit(colliders_.body[pair.a], colliders_.body[pair.b])) list_disc(start, i, contacts);
  }
  for (std::size_t i = 0; i < touches_.size(); ++i)
    if (points_[i] > 0 && are_hit(touches_[i].a, touches_[i].b)) list_touch(start, i, contacts);
}

void ContactFinder::list_disc(const StepStart& start, std::size_t contact, Contacts& contacts) const {
  std::vector<DiscContact>& bounces = contacts.disc_bounces;
  if (plan_.restitution) return void(bounces[contact].hits = true);
  bounces.push_back(discs_.contact_of(colliders_, pair_of(contacts.disc_key[contact]), start.bodies));
  bounces.back().hits = true, bounces.back().lever = lever(contacts.disc_rolls, contact);
}

void ContactFinder::list_touch(const StepStart& start, std::size_t touch, Contacts& contacts) {
  std::vector<PointContact>& bounces = contacts.point_bounces;
  std::size_t row = first_point_[touch];
  if (plan_.restitution) {
    for (std::size_t end = row + points_[touch]; row < end; ++row) bounces[row].hits = true;
    return;
  }
  if (is_known(touches_[touch]))
    manifolds_[touch] =
        touch_manifold(start.candidates, touches_[touch], touch_poses(start, touches_[touch]), nullptr);
  std::array<PointContact, 2> points;
  for (const PointContact& point : face(start, touch, points)) {
    bounces.push_back(point);
    bounces.back().hits = true, bounces.back().lever = lever(contacts.point_rolls, row++);
  }
}

}  // namespace throng
