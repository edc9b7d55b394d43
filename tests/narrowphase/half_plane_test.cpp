// SPDX-License-Identifier: MIT
#include "narrowphase/half_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plain_shapes.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

const HalfPlane kFloor{{0, 0}, {0, 1}};

TEST(HalfPlane, HoldsASquareAtItsTwoLowestVertices) {
  const Manifold m = manifold(kSquare, {{5, 0.75}}, kFloor, 0.0);
  ASSERT_EQ(m.count, 2);
  EXPECT_EQ(m.normal, Vec(0, -1));
  EXPECT_EQ(m.points[0].separation, -0.25);
  EXPECT_EQ(m.points[1].separation, -0.25);
  EXPECT_EQ(m.points[0].point, Vec(4, -0.125));
  EXPECT_EQ(m.points[1].point, Vec(6, -0.125));
}

TEST(HalfPlane, HoldsADiscAtOnePointUnderItsCentre) {
  const Manifold m = manifold(disc(1), {{3, 1.5}}, kFloor, 0.5);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.points[0].separation, 0.5);
  EXPECT_EQ(m.points[0].point, Vec(3, 0.25));
}

TEST(HalfPlane, IsOutOfReachOfAShapeFartherUp) {
  EXPECT_EQ(manifold(kSquare, {{0, 1.5}}, kFloor, 0.25).count, 0);
  EXPECT_EQ(clearance(kSquare, {{0, 1.5}}, kFloor), 0.5);
}

TEST(HalfPlane, LeavesOutTheSecondVertexWhereItIsBeyondReach) {
  const Manifold m = manifold(kSquare, pose({0, 1.2}, 0.5), kFloor, 0.1);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].separation, 1.2 - std::sqrt(2.0) * std::cos(std::numbers::pi / 4 - 0.5), 1e-15);
}

TEST(HalfPlane, FindsTheLowestOfAllVertices) {
  Random random(31);
  for (int i = 0; i < 20000; ++i) {
    const Convex shape = random_shape(random, 1.0);
    const Pose where = random_pose(random, 2.0), slope = random_pose(random, 2.0);
    const HalfPlane free{slope.position, {slope.cos, slope.sin}};
    double lowest = INFINITY;
    for (const Vec& v : shape.vertices)
      lowest = std::min(lowest, free.normal.dot(where * v - free.point) - shape.radius);
    EXPECT_NEAR(clearance(shape, where, free), lowest, 1e-14) << "seed 31, " << i;
    const Manifold m = manifold(shape, where, free, 10.0);
    ASSERT_EQ(m.count, shape.vertices.size() == 1 ? 1 : 2);
    EXPECT_NEAR(m.points[0].separation, lowest, 1e-14);
    EXPECT_GE(m.points[1 % static_cast<std::size_t>(m.count)].separation, m.points[0].separation);
    EXPECT_NEAR(free.normal.dot(m.points[0].point - free.point), lowest / 2, 1e-14);
  }
}

}  // namespace
}  // namespace throng::narrowphase
