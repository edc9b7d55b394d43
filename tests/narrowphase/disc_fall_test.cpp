// SPDX-License-Identifier: MIT
// Discs that fall onto things, against closed forms and against small steps in time.
#include "narrowphase/disc_fall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "narrowphase/disc_flight.h"
#include "narrowphase/polynomial.h"

namespace throng::narrowphase {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

TEST(Polynomial, ChangesItsSignWhereItsRootsAreOdd) {
  // (x - 1) (x - 2)^2 (x - 4): 2 is only touched, which rounding may make two changes.
  const Polynomial<4> p = {16, -36, 28, -9, 1};
  const auto found = sign_changes(p, 0.0, 10.0);
  ASSERT_TRUE(found.count == 2 || found.count == 4) << found.count;
  EXPECT_NEAR(found.at[0], 1.0, 1e-14);
  for (std::size_t i = 1; i + 1 < found.count; ++i) EXPECT_NEAR(found.at[i], 2.0, 1e-7);
  EXPECT_NEAR(found.at[found.count - 1], 4.0, 1e-13);
  EXPECT_EQ(sign_changes(p, 2.5, 3.5).count, 0u);
}

TEST(Polynomial, FindsRootsOfAllSizes) {
  for (const double scale : {1e-12, 1.0, 1e12}) {
    const Polynomial<3> p = {-6 * scale * scale * scale, 11 * scale * scale, -6 * scale, 1};  // 1, 2, 3
    const auto found = sign_changes(p, 0.0, 1e15 * scale);
    ASSERT_EQ(found.count, 3u) << scale;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(found.at[i] / scale, static_cast<double>(i + 1), 1e-13) << scale;
  }
}

TEST(DiscFall, DropsOntoAFloor) {
  const HalfPlane floor{{0, 0}, {0, 1}};
  EXPECT_NEAR(fall_time({{0, 5.5}, {1, 0}, {0, -10}}, 0.5, floor), 1.0, 1e-15);
  EXPECT_NEAR(fall_time({{0, 0.5}, {1, 10}, {0, -10}}, 0.5, floor), 2.0, 1e-15);  // thrown up from it
  EXPECT_EQ(fall_time({{0, 5.5}, {1, 0}, {0, 10}}, 0.5, floor), kNever);          // it falls upwards
  EXPECT_NEAR(fall_time({{0, 5.5}, {1, -11}, {0, 10}}, 0.5, floor), 0.6417424305044160, 1e-14);
  EXPECT_EQ(fall_time({{0, 5.5}, {1, -9.9}, {0, 10}}, 0.5, floor), kNever);  // it turns just before
}

TEST(DiscFall, LandsOnTheFaceOfASegmentFromBothSides) {
  const Convex wall = segment({-1, 0}, {1, 0});
  EXPECT_NEAR(fall_time({{0, 5.5}, {0.5, 0}, {0, -10}}, 0.5, wall, 9.0), 1.0, 1e-15);
  EXPECT_NEAR(fall_time({{0, -5.5}, {0.5, 0}, {0, 10}}, 0.5, wall, 9.0), 1.0, 1e-15);
  EXPECT_EQ(fall_time({{0, -5.5}, {0.5, 0}, {0, -10}}, 0.5, wall, 9.0), kNever);
  EXPECT_EQ(fall_time({{0, 5.5}, {0.5, 0}, {0, -10}}, 0.5, wall, 0.9), kNever);  // after until
}

TEST(DiscFall, IsCaughtByTheEndOfASegmentThatItFliesOver) {
  // Straight down onto the end, past it by 0.3 of 0.5: the centre is 0.4 above it then.
  const Convex wall = segment({-1, 0}, {1, 0});
  EXPECT_NEAR(fall_time({{1.3, 5.4}, {0, 0}, {0, -10}}, 0.5, wall, 9.0), 1.0, 1e-14);
  EXPECT_EQ(fall_time({{1.6, 5.4}, {0, 0}, {0, -10}}, 0.5, wall, 9.0), kNever);
}

TEST(DiscFall, LeavesWhatItTouchesAndComesBack) {
  const Convex ground = segment({-9, 0}, {9, 0}), ball = disc(1.0);
  EXPECT_NEAR(fall_time({{0, 0.5}, {0, 3}, {0, -10}}, 0.5, ground, 9.0), 0.6, 1e-15);
  EXPECT_NEAR(fall_time({{0, 1.5}, {0, 3}, {0, -10}}, 0.5, ball, 9.0), 0.6, 1e-13);
  EXPECT_EQ(fall_time({{0, 1.5}, {0, -3}, {0, -10}}, 0.5, ball, 9.0), 0.0);
}

// It happened: who had come to rest on a floor but for rounding fell through it.
TEST(DiscFall, LandsAgainThoughRoundingPutItBehindTheSurface) {
  const Vec touching{0, 0.49999999999999989}, up{0, 1e-9}, pull{0, -10};
  EXPECT_NEAR(fall_time({touching, up, pull}, 0.5, HalfPlane{{0, 0}, {0, 1}}), 2e-10, 1e-24);
  EXPECT_NEAR(fall_time({touching, up, pull}, 0.5, segment({-9, 0}, {9, 0}), 9.0), 2e-10, 1e-24);
  EXPECT_NEAR(fall_time({touching, up, pull}, 0.25, disc(0.25), 9.0), 2e-10, 1e-20);
  EXPECT_EQ(fall_time({{0, 0.4}, {0, 1}, pull}, 0.5, segment({-9, 0}, {9, 0}), 9.0), kNever)
      << "from below it never comes out";
}

/// The first time at which the gap is at or below 0, by looking every `step`.
double looked_up(const Fall& fall, double radius, const Convex& shape, double until, double step) {
  for (double t = 0.0; t <= until; t += step) {
    const Vec at = fall.position + t * fall.velocity + 0.5 * t * t * fall.pull;
    if (disc_flight(at, radius, {0, 0}, shape).gap <= 0.0) return t;
  }
  return kNever;
}

TEST(DiscFall, AgreesWithLookingAgainAndAgain) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const Convex shapes[] = {segment({-0.5, -0.2}, {0.6, 0.3}), disc(0.4, {0.1, 0}),
                           convex({{-0.5, -0.5}, {0.6, -0.4}, {0, 0.5}})};
  int hits = 0, tried = 0;
  for (int i = 0; i < 900; ++i) {
    const Convex& shape = shapes[i % 3];
    const Fall fall{{2 * number(random), 2 * number(random)},
                    {3 * number(random), 3 * number(random)},
                    {4 * number(random), 4 * number(random)}};
    const double radius = 0.3, step = 1e-4;
    if (disc_flight(fall.position, radius, {0, 0}, shape).gap <= 0.0) continue;
    ++tried;
    const double exact = fall_time(fall, radius, shape, 2.0);
    const double seen = looked_up(fall, radius, shape, 2.0, step);
    if (exact < kNever) {
      ++hits;
      const Vec at = fall.position + exact * fall.velocity + 0.5 * exact * exact * fall.pull;
      EXPECT_NEAR(disc_flight(at, radius, {0, 0}, shape).gap, 0.0, 1e-13) << i;
    }
    EXPECT_LE(exact, seen) << i;  // who only grazes may be seen by no look
    if (exact < seen - step) {
      const Vec after =
          fall.position + (exact + step) * fall.velocity + 0.5 * (exact + step) * (exact + step) * fall.pull;
      EXPECT_GT(disc_flight(after, radius, {0, 0}, shape).gap, -1e-12) << i << " was seen too late";
    }
  }
  EXPECT_GT(hits, tried / 5);
  EXPECT_LT(hits, 4 * tried / 5);
}

}  // namespace
}  // namespace throng::narrowphase
