// SPDX-License-Identifier: MIT
#include "narrowphase/motion/baselines/swept_hull.h"

#include <algorithm>

#include "narrowphase/bvh_fit.h"
#include "narrowphase/distance.h"
#include "narrowphase/motion/moving_convex_pair.h"

namespace throng::narrowphase {

namespace {

/// The hull of a shape at two poses, rounded by its radius and as much as it leaves the hull between them.
Convex sweep(const Convex& shape, const Pose& first, const Pose& last, double turned) {
  Points<2> points;
  double reach = 0.0;
  for (const Vec& v : shape.vertices) {
    points.push_back(first * v), points.push_back(last * v);
    reach = std::max(reach, v.norm());
  }
  reduce_to_hull<2>(points);
  return convex(std::move(points), shape.radius + reach * (turned * turned / 8.0));
}

}  // namespace

bool swept_hulls_are_apart(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                           double duration) {
  const MovingConvexPair pair(a, motion_a, b, motion_b, duration);
  const Convex of_a = sweep(a, pair.pose_a(0.0), pair.pose_a(duration), duration * pair.spin_a);
  const Convex of_b = sweep(b, pair.pose_b(0.0), pair.pose_b(duration), duration * pair.spin_b);
  return separation(of_a, {}, of_b, {}).distance > 4.0 * pair.rounding;
}

}  // namespace throng::narrowphase
