// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_parts.h"

#include <tuple>

#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

template <class Counters>
Separation nearest(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                   Counters& counters) {
  std::uint32_t first = 0, second = 0;
  Separation best = separation(a.parts[0], pose_a, b.parts[0], pose_b);
  const auto leaf = [&](const Branch& of_a, const Branch& of_b, double) {
    for (std::uint32_t k = of_a.first; k < of_a.first + of_a.count; ++k)
      for (std::uint32_t l = of_b.first; l < of_b.first + of_b.count; ++l) {
        const std::uint32_t i = a.tree.order[k], j = b.tree.order[l];
        const Separation s = separation(a.parts[i], pose_a, b.parts[j], pose_b);
        if (std::tuple(s.distance, i, j) < std::tuple(best.distance, first, second))
          best = s, first = i, second = j;
      }
    return best.distance;
  };
  const Frame<2> b_in_a = frame(relative(pose_a, pose_b), a.tree.reach + b.tree.reach);
  double upper = best.distance;
  minimise(a.tree, b.tree, b_in_a, 0.0, -std::numeric_limits<double>::infinity(), upper, leaf, counters);
  return best;
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
  return {parts, build_bvh<Box<2>>(things, append, config)};
}

Separation separation(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                      BvhCounters* counters) {
  if (counters != nullptr) return nearest(a, pose_a, b, pose_b, *counters);
  NoCounters none;
  return nearest(a, pose_a, b, pose_b, none);
}

}  // namespace throng::narrowphase
