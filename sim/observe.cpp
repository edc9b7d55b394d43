// SPDX-License-Identifier: MIT
#include "sim/observe.h"

#include <algorithm>
#include <cmath>

#include "broadphase/all_lists.h"
#include "narrowphase/distance.h"
#include "sim/contact/candidates.h"
#include "sim/crowd/walk.h"
#include "sim/measure/measured_bodies.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::Pose;

namespace {

/// Calls f(row) for dynamic bodies.
template <class F>
void for_dynamic(const Scene& scene, F f) {
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    if (scene.bodies.kind[row] == BodyKind::dynamic) f(row);
}

/// The convex part of each collider, in the world.
class Parts {
 public:
  Parts(const State& state, const Colliders& colliders) : state_(state), colliders_(colliders) {}

  Pose pose(std::uint32_t row) const {
    const std::uint32_t body = colliders_.body[row];
    return narrowphase::pose(state_.position[body], state_.angle[body]);
  }
  Convex shape(std::uint32_t row) const {
    const bool disc = colliders_.shape.empty() || !colliders_.shape[row];
    return disc ? narrowphase::disc(colliders_.radius[row]) : *colliders_.shape[row];
  }

 private:
  const State& state_;
  const Colliders& colliders_;
};

double obstacle_distance(const Convex& shape, const Pose& pose, const Obstacles& obstacles, std::uint32_t row,
                         const Vec& shift) {
  const std::size_t sides = obstacles.side.size();
  if (row < sides) return narrowphase::clearance(shape, pose, obstacles.side[row]);
  return narrowphase::separation(shape, pose, obstacles.part[row - sides], Pose{shift}).distance;
}

/// Of agents with each other, with what stops them and with bodies that move.
Overlap crowd_overlap(const Scene& scene, const State& state) {
  Overlap result;
  double largest = 0.0, sum = 0.0;
  for (std::size_t row = scene.crowd.first; row < scene.bodies.size(); ++row)
    largest = std::max(largest, scene.bodies.radius[row]);
  const auto count = [&](double depth) {
    if (!(depth > 0.0)) return;
    ++result.pairs;
    sum += depth;
    result.max = std::max(result.max, depth);
  };
  const std::size_t first = scene.crowd.first;
  const std::span<const Vec> position = std::span(state.position).subspan(first);
  const Barriers barriers(barrier_lines(scene), largest);
  Movers movers(scene);
  Barriers bodies({}, largest);
  movers.show(state, bodies);
  broadphase::NeighbourLists near;
  broadphase::AllLists().find(position, 2.0 * largest, nullptr, near);
  const auto radius = [&](std::size_t row) {
    return scene.bodies.radius[state.id[first + row] - std::size_t{1}];
  };
  for (std::size_t row = 0; row < position.size(); ++row) {
    const Vec& p = position[row];
    for (std::size_t k = near.begin[row]; k < near.begin[row + 1]; ++k)
      if (near.row[k] > row) count(radius(row) + radius(near.row[k]) - near.distance[k]);
    const auto count_edge = [&](const Vec& q) { count(radius(row) - (p - q).norm()); };
    barriers.for_each_nearest(p, radius(row), count_edge);
    const double depth = movers.depth(p);
    depth > 0.0 ? count(radius(row) + depth) : bodies.for_each_nearest(p, radius(row), count_edge);
  }
  if (result.pairs > 0) result.mean = sum / static_cast<double>(result.pairs);
  return result;
}

}  // namespace

Overlap overlap(const Scene& scene, const State& state) {
  const Plan plan = plan_for(scene, ContactModel::impulse);  // also where bodies ignore each other
  Overlap result;
  if (plan.crowd) return crowd_overlap(scene, state);
  if (!plan.contacts()) return result;
  Candidates candidates(scene, plan);
  candidates.find(state, 0.0);
  const Parts parts(state, candidates.colliders());
  double sum = 0.0;
  const auto count = [&](double distance) {
    if (!(distance < 0.0)) return;
    ++result.pairs;
    sum -= distance;
    result.max = std::max(result.max, -distance);
  };
  for (const broadphase::Pair& pair : candidates.pairs()) {
    Pose pose_b = parts.pose(pair.b);
    pose_b.position += candidates.shift(pair);
    count(narrowphase::separation(parts.shape(pair.a), parts.pose(pair.a), parts.shape(pair.b), pose_b)
              .distance);
  }
  for (const broadphase::Pair& pair : candidates.obstacle_pairs())
    count(obstacle_distance(parts.shape(pair.a), parts.pose(pair.a), candidates.obstacles(), pair.b,
                            candidates.obstacle_shift(pair.a)));
  if (result.pairs > 0) result.mean = sum / static_cast<double>(result.pairs);
  return result;
}

namespace {

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b,
                            [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

}  // namespace

bool operator==(const CrowdObservables& a, const CrowdObservables& b) {
  return a.agents == b.agents && a.arrived == b.arrived && same(a.measures, b.measures);
}

bool operator==(const Observables& a, const Observables& b) {
  return a.kinetic_energy == b.kinetic_energy && a.potential_energy == b.potential_energy &&
         a.momentum == b.momentum && a.contacts == b.contacts && a.max_overlap == b.max_overlap &&
         a.mean_overlap == b.mean_overlap && a.crowd == b.crowd && same(a.asked, b.asked);
}

namespace {

std::optional<CrowdObservables> observe_crowd(const Scene& scene, const State& state) {
  if (scene.crowd.size() == 0) return std::nullopt;
  CrowdObservables result{
      static_cast<double>(state.id.size() - scene.crowd.first), static_cast<double>(state.crowd.arrived), {}};
  for (std::size_t i = 0; i < scene.crowd.measures.size(); ++i)
    append_columns(scene.crowd.measures[i], state.crowd.measured[i],
                   {std::span(state.position).subspan(scene.crowd.first),
                    std::span(state.velocity).subspan(scene.crowd.first), state.step, scene.time.dt},
                   result.measures);
  return result;
}

}  // namespace

Observables observe(const Scene& scene, const State& state, std::span<const ContactRow> contacts) {
  const Overlap overlaps = overlap(scene, state);
  return {kinetic_energy(scene, state),
          potential_energy(scene, state),
          momentum(scene, state),
          static_cast<double>(contacts.size()),
          overlaps.max,
          overlaps.mean,
          observe_crowd(scene, state),
          measure_bodies(scene, state, contacts)};
}

double kinetic_energy(const Scene& scene, const State& state) {
  double sum = 0.0;
  for_dynamic(scene, [&](std::size_t row) {
    sum += 0.5 * mass(scene, row) * state.velocity[row].squaredNorm() +
           0.5 * inertia(scene, row) * state.spin[row] * state.spin[row];
  });
  return sum;
}

double potential_energy(const Scene& scene, const State& state) {
  double sum = 0.0;
  for_dynamic(scene,
              [&](std::size_t row) { sum -= mass(scene, row) * scene.gravity.dot(state.position[row]); });
  return sum;
}

Vec momentum(const Scene& scene, const State& state) {
  Vec sum(0.0, 0.0);
  for_dynamic(scene, [&](std::size_t row) { sum += mass(scene, row) * state.velocity[row]; });
  return sum;
}

}  // namespace throng
