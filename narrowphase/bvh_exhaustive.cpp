// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_exhaustive.h"

#include <limits>

#include "narrowphase/bvh_edges.h"

namespace throng::narrowphase {

namespace {

std::vector<OutlineEdge> placed(std::span<const OutlineEdge> shape, const Pose& pose) {
  std::vector<OutlineEdge> result;
  result.reserve(shape.size());
  for (const OutlineEdge& e : shape) result.push_back({pose * e.p, pose * e.q, e.index});
  return result;
}

/// The deepest vertex of `shape` in `solid`: depth -1 where there is none.
struct DeepestVertex {
  double depth = -1.0;
  Vec at{0.0, 0.0}, on_outline{0.0, 0.0};
  std::uint32_t vertex = 0, edge = 0;
};

DeepestVertex deepest_vertex(std::span<const OutlineEdge> solid, std::span<const OutlineEdge> shape) {
  DeepestVertex best;
  for (const OutlineEdge& e : shape) {
    if (!exhaustive_contains(solid, e.p)) continue;
    const OutlinePoint n = exhaustive_nearest(solid, e.p);
    if (n.distance > best.depth) best = {n.distance, e.p, n.point, e.index, n.edge};
  }
  return best;
}

}  // namespace

OutlineProximity exhaustive_proximity(std::span<const OutlineEdge> a, const Pose& pose_a,
                                      std::span<const OutlineEdge> b, const Pose& pose_b) {
  const std::vector<OutlineEdge> in_a = placed(b, relative(pose_a, pose_b));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double squared = kInfinity;
  OutlineProximity result{};
  for (const OutlineEdge& e : a)
    for (const OutlineEdge& f : in_a)
      if (const EdgePairPoints s = nearest_of_edges(e.p, e.q, f.p, f.q); s.squared < squared) {
        squared = s.squared;
        result = {std::sqrt(squared), std::sqrt(squared), s.on_a, s.on_b, e.index, f.index};
      }
  const DeepestVertex of_b = deepest_vertex(a, in_a), of_a = deepest_vertex(in_a, a);
  if (squared == 0.0) result.lower = -kInfinity;
  if (of_b.depth > 0.0 && of_b.depth >= of_a.depth)
    result = {-kInfinity, -of_b.depth, of_b.on_outline, of_b.at, of_b.edge, of_b.vertex};
  else if (of_a.depth > 0.0)
    result = {-kInfinity, -of_a.depth, of_a.at, of_a.on_outline, of_a.vertex, of_a.edge};
  result.point_a = pose_a * result.point_a;
  result.point_b = pose_a * result.point_b;
  return result;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> exhaustive_meetings(std::span<const OutlineEdge> a,
                                                                         const Pose& pose_a,
                                                                         std::span<const OutlineEdge> b,
                                                                         const Pose& pose_b) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
  const std::vector<OutlineEdge> in_a = placed(b, relative(pose_a, pose_b));
  for (const OutlineEdge& e : a)
    for (const OutlineEdge& f : in_a)
      if (segments_meet(e.p, e.q, f.p, f.q)) result.emplace_back(e.index, f.index);
  return result;
}

OutlinePoint exhaustive_nearest(std::span<const OutlineEdge> shape, const Vec& point) {
  double squared = std::numeric_limits<double>::infinity();
  OutlinePoint best{};
  for (const OutlineEdge& e : shape)
    if (const EdgePoint n = nearest_on_edge(point, e.p, e.q); n.squared < squared) {
      squared = n.squared;
      best = {std::sqrt(squared), n.point, e.index};
    }
  return best;
}

bool exhaustive_contains(std::span<const OutlineEdge> shape, const Vec& point) {
  bool inside = false;
  for (const OutlineEdge& e : shape) inside ^= ray_passes(point, e.p, e.q);
  return inside;
}

}  // namespace throng::narrowphase
