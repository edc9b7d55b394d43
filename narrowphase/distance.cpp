// SPDX-License-Identifier: MIT
#include "narrowphase/distance.h"

#include <algorithm>
#include <array>

#include "narrowphase/core_separation.h"
#include "narrowphase/relative.h"
#include "narrowphase/search.h"

namespace throng::narrowphase {

namespace {

/// An order of placed shapes that doesn't know which one the caller named first: more vertices first.
bool precedes(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b) {
  if (a.vertices.size() != b.vertices.size()) return a.vertices.size() > b.vertices.size();
  const std::array of_a{pose_a.position.x(), pose_a.position.y(), pose_a.cos, pose_a.sin, a.radius};
  const std::array of_b{pose_b.position.x(), pose_b.position.y(), pose_b.cos, pose_b.sin, b.radius};
  if (of_a != of_b) return of_a < of_b;
  return std::lexicographical_compare(a.vertices.begin(), a.vertices.end(), b.vertices.begin(),
                                      b.vertices.end(), lies_before);
}

Separation with_disc(const Convex& a, const Pose& pose_a, const Convex& disc, const Pose& pose) {
  const Vec centre = relative(pose_a, pose) * disc.vertices[0];
  return in_world(
      a, pose_a, disc,
      a.normals.empty() ? disc_disc(a.vertices[0], centre - a.vertices[0]) : polygon_disc(a, centre));
}

Separation ordered(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b) {
  if (b.normals.empty()) return with_disc(a, pose_a, b, pose_b);
  ClosestFeatures features;
  SearchStatistics statistics;
  return search({a, pose_a, b, pose_b}, false, features, statistics);
}

}  // namespace

Separation separation(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b) {
  if (!precedes(b, pose_b, a, pose_a)) return ordered(a, pose_a, b, pose_b);
  const Separation s = ordered(b, pose_b, a, pose_a);
  return {s.distance, -s.normal, s.point_b, s.point_a};
}

}  // namespace throng::narrowphase
