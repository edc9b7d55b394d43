// SPDX-License-Identifier: MIT
#include "sim/overlap.h"

#include <algorithm>

#include "broadphase/all_lists.h"
#include "narrowphase/distance.h"
#include "sim/contact/candidates.h"
#include "sim/crowd/barriers.h"
#include "sim/crowd/movers.h"
#include "sim/crowd/walk.h"
#include "sim/plan.h"

namespace throng {

using narrowphase::Convex;
using narrowphase::Pose;

namespace {

/// The convex part of each collider, in the world.
class ColliderParts {
 public:
  ColliderParts(const State& state, const Colliders& colliders) : state_(state), colliders_(colliders) {}

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
  if (obstacles.is_side(row)) return narrowphase::clearance(shape, pose, obstacles.side[row]);
  return narrowphase::separation(shape, pose, obstacles.part_at(row), Pose{shift}).distance;
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

/// `plan_` also where bodies ignore each other.
Overlaps::Overlaps(const Scene& scene) : scene_(scene), plan_(plan_for(scene, ContactModel::impulse)) {
  if (!plan_.crowd && plan_.contacts()) candidates_ = std::make_unique<Candidates>(scene, plan_, alone_);
}

Overlaps::~Overlaps() = default;

/// Calls f(depth, a, b) for each two parts that are in each other, by rows of their bodies; b is a itself for
/// what doesn't move.
template <class F>
void Overlaps::for_each(const State& state, F f) {
  if (!candidates_) return;
  Candidates& candidates = *candidates_;
  candidates.find(state, 0.0);
  const Colliders& colliders = candidates.colliders();
  const ColliderParts parts(state, colliders);
  for (const broadphase::Pair& pair : candidates.pairs()) {
    Pose pose_b = parts.pose(pair.b);
    pose_b.position += candidates.shift(pair);
    const double distance =
        narrowphase::separation(parts.shape(pair.a), parts.pose(pair.a), parts.shape(pair.b), pose_b)
            .distance;
    if (distance < 0.0) f(-distance, colliders.body[pair.a], colliders.body[pair.b]);
  }
  for (const broadphase::Pair& pair : candidates.obstacle_pairs()) {
    const double distance = obstacle_distance(parts.shape(pair.a), parts.pose(pair.a), candidates.obstacles(),
                                              pair.b, candidates.obstacle_shift(pair.a));
    if (distance < 0.0) f(-distance, colliders.body[pair.a], colliders.body[pair.a]);
  }
}

Overlap Overlaps::of(const State& state) {
  if (plan_.crowd) return crowd_overlap(scene_, state);
  Overlap result;
  double sum = 0.0;
  for_each(state, [&](double depth, std::uint32_t, std::uint32_t) {
    ++result.pairs;
    sum += depth;
    result.max = std::max(result.max, depth);
  });
  if (result.pairs > 0) result.mean = sum / static_cast<double>(result.pairs);
  return result;
}

std::vector<double> Overlaps::deepest(const State& state) {
  std::vector<double> deepest(scene_.bodies.size(), 0.0);
  for_each(state, [&](double depth, std::uint32_t a, std::uint32_t b) {
    deepest[a] = std::max(deepest[a], depth), deepest[b] = std::max(deepest[b], depth);
  });
  return deepest;
}

Overlap overlap(const Scene& scene, const State& state) {
  return Overlaps(scene).of(state);
}

}  // namespace throng
