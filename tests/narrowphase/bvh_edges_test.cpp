// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_edges.h"

#include <gtest/gtest.h>

#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

Vec normal(const Vec& p, const Vec& q, const Vec& r, const Vec& s) {
  return normal_of_edges(nearest_of_edges(p, q, r, s), p, q, r, s);
}

TEST(NormalOfEdges, GoesFromTheFirstToTheSecond) {
  EXPECT_EQ(normal({0, 0}, {2, 0}, {1, 3}, {1, 5}), Vec(0, 1)) << "from a middle to an end";
  EXPECT_EQ(normal({0, 0}, {2, 0}, {1, -3}, {1, -5}), Vec(0, -1));
  EXPECT_EQ(normal({1, 3}, {1, 5}, {0, 0}, {2, 0}), Vec(0, -1)) << "from an end to a middle";
  EXPECT_EQ(normal({0, 0}, {2, 0}, {5, 4}, {9, 4}), Vec(0.6, 0.8)) << "from an end to an end";
  EXPECT_EQ(normal({0, 0}, {2, 0}, {1, 3}, {7, 3}), Vec(0, 1)) << "of parallels";
}

/// An end 1e-12 from the middle of an edge 20 m long, turned anyhow: what the two nearest points say of the
/// direction is off by 1e-4.
TEST(NormalOfEdges, KeepsItsDigitsHoweverNearTheTwoAre) {
  Random random(20261121);
  double of_points = 0.0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Pose turned = random_pose(random, 5.0);
    const Vec p = turned * Vec(-10, 0), q = turned * Vec(10, 0);
    const Vec r = turned * Vec(uniform(random, -9, 9), 1e-12), s = turned * Vec(uniform(random, -9, 9), 1);
    const EdgePairPoints nearest = nearest_of_edges(p, q, r, s);
    if (nearest.squared == 0.0) continue;
    of_points = std::max(of_points, std::abs(dot((nearest.on_b - nearest.on_a).normalized(), q - p)));
    ASSERT_LE(std::abs(dot(normal(p, q, r, s), q - p)), 1e-13) << "seed 20261121, trial " << trial;
    ASSERT_LE(std::abs(dot(normal(r, s, p, q), q - p)), 1e-13) << "seed 20261121, trial " << trial;
    ASSERT_GT(dot(normal(p, q, r, s), s - p), 0.0) << "seed 20261121, trial " << trial;
  }
  EXPECT_GT(of_points, 1e-4);
}

}  // namespace
}  // namespace throng::narrowphase
