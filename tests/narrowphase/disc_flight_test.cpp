// SPDX-License-Identifier: MIT
// When a disc that flies straight touches something: by hand, and against the exact distance at that time.
#include "narrowphase/disc_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "narrowphase/distance.h"
#include "plain_shapes.h"

namespace throng::narrowphase {
namespace {

TEST(DiscFlight, HeadOnTakesTheGapOverTheSpeed) {
  EXPECT_DOUBLE_EQ(disc_flight({5, 0}, {-2, 0}, 1.0, 3.0).time, 2.0);
  EXPECT_TRUE(std::isinf(disc_flight({5, 0}, {-2, 0}, 1.0, 1.9).time));
  EXPECT_DOUBLE_EQ(disc_flight({3, 4}, {-3, -3}, 5.0, 3.0).time, 0.0);
  EXPECT_DOUBLE_EQ(disc_flight({5, 0}, 1.0, {-2, 0}, kSquare).time, 1.5);
  EXPECT_DOUBLE_EQ(disc_flight({5, 0}, 1.0, {-2, 0}, HalfPlane{{1, 7}, {1, 0}}).time, 1.5);
}

TEST(DiscFlight, ACornerIsRoundedByTheDisc) {
  // Towards (1, 1) along the diagonal: the centre stops sqrt(2) - 1 disc's radius before it.
  EXPECT_NEAR(disc_flight({4, 4}, 1.0, {-1, -1}, kSquare).time, 3.0 - std::sqrt(0.5), 1e-15);
  EXPECT_DOUBLE_EQ(disc_flight({-3, 2}, 1.0, {1, 0}, kSquare).gap, std::sqrt(5.0) - 1.0);
}

TEST(DiscFlight, WhatPassesByOrLeavesNeverTouches) {
  EXPECT_TRUE(std::isinf(disc_flight({5, 2.5}, 1.0, {-2, 0}, kSquare).time));
  EXPECT_TRUE(std::isinf(disc_flight({5, 0}, 1.0, {2, 0}, kSquare).time));
  EXPECT_TRUE(std::isinf(disc_flight({2, 0}, 1.0, {1, 5}, kSquare).time));
}

TEST(DiscFlight, WhatTouchesHitsAtOnceWhereItNearsAndNeverWhereItSlides) {
  EXPECT_EQ(disc_flight({2, 0}, 1.0, {-1, 5}, kSquare).time, 0.0);
  EXPECT_TRUE(std::isinf(disc_flight({2, 0}, 1.0, {0, 5}, kSquare).time));
  EXPECT_TRUE(std::isinf(disc_flight({2, 0.99999999}, 1.0, {0, 5}, kSquare).time))
      << "no ghost at the corner";
}

TEST(DiscFlight, ASegmentHasTwoSidesAndTwoEnds) {
  const Convex wall = segment({-1, 0}, {1, 0});
  EXPECT_DOUBLE_EQ(disc_flight({0, 3}, 0.5, {0, -1}, wall).time, 2.5);
  EXPECT_DOUBLE_EQ(disc_flight({0, -3}, 0.5, {0, 1}, wall).time, 2.5);
  EXPECT_DOUBLE_EQ(disc_flight({3, 0}, 0.5, {-1, 0}, wall).time, 1.5);
  EXPECT_DOUBLE_EQ(disc_flight({0, 0.25}, 0.5, {0, -1}, wall).gap, -0.25);
}

TEST(DiscFlight, InsideOfAPolygonTheGapIsDeeperThanTheRadius) {
  EXPECT_DOUBLE_EQ(disc_flight({0.5, 0}, 0.25, {1, 0}, kSquare).gap, -0.75);
}

TEST(DiscFlight, AtTheTimeTheDistanceIsNothing) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  const Convex shapes[] = {kSquare, convex({{0, -1}, {2, 1}, {-1, 1}}, 0.3), segment({-1, -2}, {2, 0}, 0.1),
                           disc(0.7, {0.2, 0.1})};
  int hits = 0;
  for (int i = 0; i < 40000; ++i) {
    const Convex& shape = shapes[i % 4];
    const Convex ball = disc(0.4);
    const Vec centre(any(random), any(random)), velocity(any(random), any(random));
    const DiscFlight flight = disc_flight(centre, 0.4, velocity, shape);
    const double gap = separation(ball, Pose{centre}, shape, Pose{}).distance;
    EXPECT_EQ(flight.gap > 0.0, gap > 0.0);
    if (!(gap > 0.0)) continue;
    EXPECT_NEAR(flight.gap, gap, 1e-14);
    const double last = std::isinf(flight.time) ? 10.0 : flight.time;
    for (int k = 1; k < 20; ++k)
      EXPECT_GT(separation(ball, Pose{centre + last * k / 20 * velocity}, shape, Pose{}).distance, -1e-12);
    if (std::isinf(flight.time)) continue;
    ++hits;
    const Vec at = centre + flight.time * velocity;
    EXPECT_NEAR(separation(ball, Pose{at}, shape, Pose{}).distance, 0.0, 1e-13);
    EXPECT_GT(towards(at, shape).dot(velocity), 0.0);
  }
  EXPECT_GT(hits, 7000);
}

}  // namespace
}  // namespace throng::narrowphase
