// SPDX-License-Identifier: MIT
#include "narrowphase/nearest_parts.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// No more than the distance of what the two hold.
double least_distance(const Bound& a, const Bound& b) {
  return (b.centre - a.centre).norm() - (a.radius + b.radius);
}

Bound around(std::span<const Bound> bounds) {
  Bound all{bounds[0].centre, 0.0};
  for (const Bound& one : bounds)
    all.radius = std::max(all.radius, (one.centre - all.centre).norm() + one.radius);
  return all;
}

}  // namespace

Bound bound(const Convex& part, const Pose& pose) {
  Vec middle(0.0, 0.0);
  for (const Vec& v : part.vertices) middle += v / static_cast<double>(part.vertices.size());
  double radius = 0.0;
  for (const Vec& v : part.vertices) radius = std::max(radius, (v - middle).norm());
  const Vec centre = pose * middle;
  constexpr double kRounding = 1e-14;
  return {centre,
          radius + part.radius + kRounding * (centre.norm() + pose.position.norm() + middle.norm() + radius)};
}

Separation separation(std::span<const Convex> a, const Pose& pose_a, std::span<const Convex> b,
                      const Pose& pose_b) {
  assert(!a.empty() && !b.empty());
  const Pose b_in_a = relative(pose_a, pose_b);  // far from the origin nothing is lost
  std::vector<Bound> bounds;
  for (const Convex& part : b) bounds.push_back(bound(part, b_in_a));
  const Bound all = around(bounds);
  Separation best = separation(a[0], pose_a, b[0], pose_b);
  for (const Convex& part : a) {
    const Bound own = bound(part, Pose{});
    if (least_distance(own, all) >= best.distance) continue;
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (least_distance(own, bounds[j]) >= best.distance) continue;
      const Separation s = separation(part, pose_a, b[j], pose_b);
      if (s.distance < best.distance) best = s;
    }
  }
  return best;
}

}  // namespace throng::narrowphase
