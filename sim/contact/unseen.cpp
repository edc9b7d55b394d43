// SPDX-License-Identifier: MIT
#include "sim/contact/unseen.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/motion/first_contact.h"
#include "sim/contact/contact_key.h"

namespace throng {

using broadphase::Box;
using narrowphase::Convex;
using narrowphase::Motion;
using narrowphase::Verdict;

namespace {

/// What acts on the two from their contacts' list is seen.
bool is_listed(const Contacts& contacts, std::uint64_t key) {
  return std::ranges::binary_search(contacts.disc_key, key) ||
         std::ranges::binary_search(contacts.point_key, key);
}

}  // namespace

bool Unseen::met(std::span<const Reached> strays, const State& state, std::span<const SolverBody> bodies,
                 const Contacts& contacts) {
  if (candidates_.repeats() || !candidates_.rows().are_all()) return true;
  const Step step{state, bodies, contacts};
  index(strays);
  bool any = std::ranges::any_of(strays, [&](const Reached& s) { return met_obstacle(step, s.collider); });
  if (any) return true;
  candidates_.rows().for_each([&](std::uint32_t other) {
    if (any) return;
    index_.for_each_near(box(other),
                         [&](std::uint32_t k) { any = any || met_another(step, strays[k].collider, other); });
  });
  return any;
}

/// Where all may have been, and an index of that of the strays.
void Unseen::index(std::span<const Reached> strays) {
  const std::vector<double>& radius = candidates_.colliders().radius;
  reach_.resize(radius.size()), extents_.clear();
  candidates_.rows().for_each([&](std::uint32_t i) { reach_[i] = candidates_.outer_reach(i); });
  for (const auto& [i, way] : strays) reach_[i] = std::max(reach_[i], radius[i] + way);
  for (const auto& [i, way] : strays) extents_.push_back(broadphase::Extent::of(box(i)));
  index_.build(extents_);
}

Box Unseen::box(std::uint32_t i) const {
  const Vec& centre = candidates_.centre(i);
  return {Vec(centre.array() - reach_[i]), Vec(centre.array() + reach_[i])};
}

bool Unseen::met_another(const Step& step, std::uint32_t a, std::uint32_t b) {
  const Colliders& colliders = candidates_.colliders();
  if (colliders.body[a] == colliders.body[b]) return false;
  const double reach = reach_[a] + reach_[b];
  if (!((candidates_.centre(b) - candidates_.centre(a)).squaredNorm() <= reach * reach)) return false;
  if (is_listed(step.contacts, key_of({std::min(a, b), std::max(a, b)}, false))) return false;
  const Convex& wide = widened(a, bend(step, a) + bend(step, b));
  const Convex& other = shape(colliders, b, disc_);
  return first_contact(wide, motion(step, a), other, motion(step, b), 1.0).verdict != Verdict::free;
}

bool Unseen::met_obstacle(const Step& step, std::uint32_t collider) {
  const Obstacles& obstacles = candidates_.obstacles();
  for (std::uint32_t side = 0; side < obstacles.side.size(); ++side)
    if (met_side(step, collider, side)) return true;
  bool any = false;
  candidates_.for_each_obstacle_near(box(collider), [&](std::uint32_t row) {
    if (any || is_listed(step.contacts, key_of({collider, row}, true))) return;
    const Convex& part = obstacles.part[row - obstacles.side.size()];
    const Convex& wide = widened(collider, bend(step, collider));
    any = first_contact(wide, motion(step, collider), part, Motion{}, 1.0).verdict != Verdict::free;
  });
  return any;
}

/// A straight way beyond a straight border ends beyond it.
bool Unseen::met_side(const Step& step, std::uint32_t collider, std::uint32_t side) {
  if (is_listed(step.contacts, key_of({collider, side}, true))) return false;
  const Motion way = motion(step, collider);
  const Convex& part = shape(candidates_.colliders(), collider, disc_);
  const narrowphase::HalfPlane& border = candidates_.obstacles().side[side];
  return !(clearance(part, pose_at(way, 1.0), border) > bend(step, collider));
}

/// Straight from where it was to where it is, in a time of 1.
Motion Unseen::motion(const Step& step, std::uint32_t collider) const {
  const std::uint32_t body = candidates_.colliders().body[collider];
  const Vec& from = step.state.position[body];
  return {from, step.state.angle[body], step.bodies[body].position - from, step.bodies[body].turn};
}

/// m, how far from there it may have been in between.
double Unseen::bend(const Step& step, std::uint32_t collider) const {
  const Colliders& colliders = candidates_.colliders();
  const std::uint32_t body = colliders.body[collider];
  const double arm =
      colliders.centre.empty() ? 0.0 : colliders.centre[collider].norm() + colliders.radius[collider];
  const double change = (step.bodies[body].velocity - step.state.velocity[body]).norm() +
                        arm * std::abs(step.bodies[body].spin - step.state.spin[body]);
  return 0.25 * dt_ * change;
}

const Convex& Unseen::widened(std::uint32_t collider, double by) {
  wide_ = shape(candidates_.colliders(), collider, disc_);
  wide_.radius += by;
  return wide_;
}

}  // namespace throng
