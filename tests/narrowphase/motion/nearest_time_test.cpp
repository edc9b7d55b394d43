// SPDX-License-Identifier: MIT
#include "narrowphase/motion/nearest_time.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "moving_shapes.h"
#include "narrowphase/distance.h"

namespace throng::narrowphase {
namespace {

double gap_at(const MovingPairOfShapes& p, double time) {
  return separation(p.a, pose_at(p.motion_a, time), p.b, pose_at(p.motion_b, time)).distance;
}

TEST(NearestTime, OfADiscThatPassesACornerIsWhenItIsOverIt) {
  const double time = nearest_time(disc(0.1), {{-3, 0.11}, 0, {6, 0}, 0}, segment({0, 0}, {0, -5}), {}, 1.0);
  EXPECT_NEAR(time, 0.5, 1e-3);
}

TEST(NearestTime, OfShapesThatOnlyNearOrPartIsAnEnd) {
  const Convex a = disc(0.5), b = convex({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  EXPECT_EQ(nearest_time(a, {{-5, 0}, 0, {1, 0}, 0}, b, {}, 2.0), 2.0);
  EXPECT_EQ(nearest_time(a, {{-5, 0}, 0, {-1, 0}, 0}, b, {}, 2.0), 0.0);
}

/// The farthest point of a shape along a direction, in the world.
double support(const Convex& shape, const Pose& pose, const Vec& along) {
  double most = -1e300;
  for (const Vec& v : shape.vertices) most = std::max(most, along.dot(pose * v));
  return most + shape.radius;
}

/// The promise: the line between the two stays between them.
TEST(NearestTime, OfShapesThatDontTurnIsWhenTheLineBetweenThemPartsThemAllTheTime) {
  Random random(4);
  int passed = 0;
  for (int i = 0; i < 4000; ++i) {
    MovingPairOfShapes p = random_motions(random);
    p.motion_a.spin = p.motion_b.spin = 0.0;
    if (first_contact(p.a, p.motion_a, p.b, p.motion_b, 1.0).verdict != Verdict::free) continue;
    const double time = nearest_time(p.a, p.motion_a, p.b, p.motion_b, 1.0);
    const Separation s = separation(p.a, pose_at(p.motion_a, time), p.b, pose_at(p.motion_b, time));
    for (const double end : {0.0, 1.0}) {
      const double right = support(p.a, pose_at(p.motion_a, end), s.normal);
      const double left = -support(p.b, pose_at(p.motion_b, end), -s.normal);
      ASSERT_GT(left - right, 0.45 * s.distance) << i << " at " << end << " of " << time;
    }
    passed += time > 0.0 && time < 1.0;
  }
  EXPECT_GT(passed, 500) << "nothing to pass by";
}

TEST(NearestTime, OfShapesThatTurnIsAboutWhenNoInstantIsNearer) {
  Random random(5);
  int passed = 0, poor = 0;
  for (int i = 0; i < 2000; ++i) {
    MovingPairOfShapes p = random_motions(random);
    p.motion_a.spin *= 0.25, p.motion_b.spin *= 0.25;  // so that mostly only one instant is near
    if (first_contact(p.a, p.motion_a, p.b, p.motion_b, 1.0).verdict != Verdict::free) continue;
    const double gap = gap_at(p, nearest_time(p.a, p.motion_a, p.b, p.motion_b, 1.0));
    double least = gap;
    for (int k = 0; k <= 200; ++k) least = std::min(least, gap_at(p, k / 200.0));
    ++passed, poor += gap > least + 0.1;
  }
  EXPECT_GT(passed, 500);
  EXPECT_LT(poor, passed / 20);
}

}  // namespace
}  // namespace throng::narrowphase
