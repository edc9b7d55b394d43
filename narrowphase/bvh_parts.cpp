// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_parts.h"

#include <tuple>

#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// The nearest pair of parts so far.
struct NearestParts {
  Separation separation;
  std::uint32_t a, b;
};

/// Improves on `best`; `ask(i, j)` says how far two parts are. Returns a lower bound of the least distance.
template <class Ask, class Counters>
double find_nearest(const PartsBvh& a, const PartsBvh& b, const Pose& b_in_a, double relative_error,
                    NearestParts& best, Ask ask, Counters& counters) {
  const auto leaf = [&](const Branch& of_a, const Branch& of_b, double) {
    for (std::uint32_t k = of_a.first; k < of_a.first + of_a.count; ++k)
      for (std::uint32_t l = of_b.first; l < of_b.first + of_b.count; ++l) {
        const std::uint32_t i = a.tree.order[k], j = b.tree.order[l];
        const Separation s = ask(i, j);
        if (std::tuple(s.distance, i, j) < std::tuple(best.separation.distance, best.a, best.b))
          best = {s, i, j};
      }
    return best.separation.distance;
  };
  double upper = best.separation.distance;
  return minimise(a.tree, b.tree, frame(b_in_a, a.tree.reach + b.tree.reach), relative_error,
                  -std::numeric_limits<double>::infinity(), upper, leaf, counters);
}

PartsMemory::Features& place(PartsMemory& memory, std::uint32_t i, std::uint32_t j) {
  PartsMemory::Features& found = memory.features[(i * 37 + j) % memory.features.size()];
  if (found.a != i || found.b != j) found = {i, j, {}};
  return found;
}

}  // namespace

PartsBvh parts_bvh(std::span<const Convex> parts, const BvhConfig& config) {
  std::vector<Thing<2>> things;
  for (const Convex& part : parts) {
    Thing<2> thing{part.vertices[0], part.vertices[0], part.radius};
    for (const Vec& v : part.vertices) thing.low = thing.low.cwiseMin(v), thing.high = thing.high.cwiseMax(v);
    things.push_back(thing);
  }
  const auto append = [&](std::uint32_t i, Points<2>& points) {
    points.insert(points.end(), parts[i].vertices.begin(), parts[i].vertices.end());
  };
  return {parts, build_bvh<BoxAndBall<2>>(things, append, config)};
}

Separation separation(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                      BvhCounters* counters) {
  return rough_separation(a, pose_a, b, pose_b, 0.0, counters).separation;
}

RoughSeparation rough_separation(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                                 double relative_error, BvhCounters* counters) {
  const auto ask = [&](std::uint32_t i, std::uint32_t j) {
    return separation(a.parts[i], pose_a, b.parts[j], pose_b);
  };
  NearestParts best{ask(0, 0), 0, 0};
  const double lower = counting(counters, [&](auto& c) {
    return find_nearest(a, b, relative(pose_a, pose_b), relative_error, best, ask, c);
  });
  return {best.separation, std::min(lower, best.separation.distance)};
}

Separation track(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                 PartsMemory& memory, BvhCounters* counters, SearchStatistics* statistics) {
  const auto ask = [&](std::uint32_t i, std::uint32_t j) {
    return track(a.parts[i], pose_a, b.parts[j], pose_b, place(memory, i, j).features, statistics);
  };
  const std::uint32_t i = memory.a < a.parts.size() ? memory.a : 0,
                      j = memory.b < b.parts.size() ? memory.b : 0;
  NearestParts best{ask(i, j), i, j};
  counting(counters, [&](auto& c) { find_nearest(a, b, relative(pose_a, pose_b), 0.0, best, ask, c); });
  memory.a = best.a, memory.b = best.b;
  return best.separation;
}

}  // namespace throng::narrowphase
