// SPDX-License-Identifier: MIT
#include "sim/contact/unseen.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/motion/first_contact.h"
#include "sim/contact/contact_key.h"
#include "sim/simulation_error.h"

namespace throng {

using broadphase::Box;
using narrowphase::Convex;
using narrowphase::Motion;
using narrowphase::Verdict;

namespace {

constexpr double kSunk = 0.01;   // of the bounding radius: so much deeper is unseen
constexpr double kTurned = 0.5;  // rad: what turned farther may have been anywhere within its bounding disc

enum class Listed { no, at_one_point, all };

/// How the contacts' list has the two. A disc's one point is all there is.
Listed listed(const Contacts& contacts, std::uint64_t key) {
  if (std::ranges::binary_search(contacts.disc_key, key)) return Listed::all;
  const auto [first, end] = std::equal_range(contacts.point_key.begin(), contacts.point_key.end(), key);
  return first == end ? Listed::no : end - first == 1 ? Listed::at_one_point : Listed::all;
}

}  // namespace

bool Unseen::met(std::span<const Reached> strays, const State& state, BodyRows<const SolverBody> bodies,
                 const Contacts& contacts) {
  if (candidates_.repeats() || !candidates_.rows().are_all()) return true;
  if (!std::ranges::all_of(strays, [](const Reached& s) { return s.way < kFarthestPlace; })) return true;
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
  const Motion way_a = motion(step, a), way_b = motion(step, b);
  const Convex& other = shape(colliders, b, other_disc_);
  switch (listed(step.contacts, key_of({std::min(a, b), std::max(a, b)}, false))) {
    case Listed::all:
      return false;
    case Listed::at_one_point:
      return sank(a, way_a, other, way_b);
    case Listed::no:
      break;
  }
  const Convex& wide = widened(a, bend(step, a) + bend(step, b));
  return first_contact(wide, way_a, other, way_b, 1.0).verdict != Verdict::free;
}

/// Whether another point than the one that is listed got into the other shape, deeper than before.
bool Unseen::sank(std::uint32_t collider, const Motion& way, const Convex& other, const Motion& other_way) {
  const Convex& its = widened(collider, 0.0);
  if (its.vertices.size() < 2 || other.vertices.size() < 2) return false;
  const auto depth = [&](double time) {
    return std::min(least_separation(manifold(its, pose_at(way, time), other, pose_at(other_way, time), 0.0)),
                    0.0);
  };
  return depth(1.0) < depth(0.0) - kSunk * candidates_.colliders().radius[collider];
}

bool Unseen::met_obstacle(const Step& step, std::uint32_t collider) {
  const Obstacles& obstacles = candidates_.obstacles();
  for (std::uint32_t side = 0; side < obstacles.side.size(); ++side)
    if (met_side(step, collider, side)) return true;
  bool any = false;
  candidates_.for_each_obstacle_near(box(collider), [&](std::uint32_t row) {
    if (any) return;
    any = met_part(step, collider, row, obstacles.part_at(row));
  });
  return any;
}

bool Unseen::met_part(const Step& step, std::uint32_t collider, std::uint32_t row, const Convex& part) {
  const Listed its = listed(step.contacts, key_of({collider, row}, true));
  if (its == Listed::all) return false;
  const Motion way = motion(step, collider);
  if (its == Listed::at_one_point) return sank(collider, way, part, Motion{});
  const Convex& wide = widened(collider, bend(step, collider));
  return first_contact(wide, way, part, Motion{}, 1.0).verdict != Verdict::free;
}

/// A straight way beyond a straight border ends beyond it, but of what turns.
bool Unseen::met_side(const Step& step, std::uint32_t collider, std::uint32_t side) {
  const Listed its = listed(step.contacts, key_of({collider, side}, true));
  if (its == Listed::all) return false;
  const Convex& part = shape(candidates_.colliders(), collider, disc_);
  const Motion way = motion(step, collider);
  const narrowphase::HalfPlane& border = candidates_.obstacles().side[side];
  const auto free = [&](double time) { return clearance(part, pose_at(way, time), border); };
  if (its == Listed::at_one_point)
    return part.vertices.size() > 1 &&
           free(1.0) < std::min(0.0, free(0.0)) - kSunk * candidates_.colliders().radius[collider];
  const double at_end = std::abs(way.spin) > kTurned
                            ? (pose_at(way, 1.0).position - border.point).dot(border.normal) - arm(collider)
                            : free(1.0);
  return !(at_end > bend(step, collider));
}

/// m, from the body's centre, which nothing of the collider is farther from.
double Unseen::arm(std::uint32_t collider) const {
  const Colliders& colliders = candidates_.colliders();
  return colliders.radius[collider] + (colliders.centre.empty() ? 0.0 : colliders.centre[collider].norm());
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
  const double arm = is_disc(colliders, collider) ? 0.0 : this->arm(collider);  // that turn in themselves
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
