// SPDX-License-Identifier: MIT
#include "narrowphase/motion/safe_time.h"

#include <gtest/gtest.h>

#include "moving_solids.h"

namespace throng::narrowphase {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SafeTimeQuestion wanting(double before, double after) {
  SafeTimeQuestion question;
  question.before = before, question.after = after;
  return question;
}

TEST(SafeTime, IsTheDistanceOverTheRate) {
  const std::vector<Convex> ball{disc(1.0)}, off_centre{disc(0.5, {2.0, 0.0})};
  const PartsBvh a = parts_bvh(ball), b = parts_bvh(off_centre);
  // 7 - 1 - 2.5 = 3.5 m apart; the second turns at 0.25 rad/s about a point 2 m from its centre.
  const SafeTime safe = safe_time(a, Pose{}, b, pose({7, 0}, M_PI), {3.0, 9.0, 0.25}, {});
  EXPECT_NEAR(safe.before, 1.0, 1e-12);
  EXPECT_EQ(safe.after, safe.before);
  EXPECT_FALSE(safe.hit);
}

TEST(SafeTime, IsInfiniteWhereNothingMoves) {
  const std::vector<Convex> ball{disc(1.0)};
  const PartsBvh a = parts_bvh(ball);
  EXPECT_EQ(safe_time(a, Pose{}, a, Pose{{3, 0}}, {0, 0, 0}, {}).after, kInfinity);
  EXPECT_GT(safe_time(a, Pose{}, a, Pose{{3, 0}}, {5e-324, 5e-324, 5e-324}, {}).after, 1e300);
}

TEST(SafeTime, TellsWhichPartsTouchOrLimitIt) {
  std::vector<Convex> row;
  for (int i = 0; i < 40; ++i) row.push_back(disc(0.1, {1.0 * i, 0.0}));
  const std::vector<Convex> point{disc(0.1)};
  const PartsBvh a = parts_bvh(row), b = parts_bvh(point);
  const SafeTime limit = safe_time(a, Pose{}, b, Pose{{23, 0.5}}, {1, 0, 0}, {});
  EXPECT_NEAR(limit.after, 0.3, 1e-12);
  EXPECT_EQ(limit.part_a, 23u);
  const SafeTime hit = safe_time(a, Pose{}, b, Pose{{17.05, 0}}, {1, 0, 0}, {});
  EXPECT_TRUE(hit.hit);
  EXPECT_EQ(hit.part_a, 17u);
  EXPECT_EQ(hit.after, 0.0);
  EXPECT_TRUE(safe_time(a, Pose{}, b, Pose{{17.05, 0}}, {1, 0, 0}, wanting(0, 0)).hit)
      << "also of an instant";
}

TEST(SafeTime, OfFarObstaclesIsOneComparison) {
  Random random(3);
  std::vector<Convex> obstacles;
  for (int i = 0; i < 1000; ++i) obstacles.push_back(disc(0.1, random_vec(random, 5, 5)));
  const std::vector<Convex> ball{disc(1.0)};
  const PartsBvh a = parts_bvh(ball), b = parts_bvh(obstacles);
  BvhCounters counters;
  const SafeTime safe = safe_time(a, Pose{{20, 0}}, b, Pose{}, {1, 1, 1}, wanting(0.5, 0.5), &counters);
  EXPECT_GE(safe.after, 0.5);
  EXPECT_EQ(counters.nodes, 1u);
  EXPECT_EQ(counters.leaves, 0u);
}

TEST(SafeTime, LeavesOutWhatPosesMayBeOffBy) {
  const std::vector<Convex> ball{disc(1.0)};
  const PartsBvh a = parts_bvh(ball);
  SafeTimeQuestion question;
  question.pose_error = 0.25;
  EXPECT_NEAR(safe_time(a, Pose{}, a, Pose{{3, 0}}, {1, 0, 0}, question).after, 0.75, 1e-12);
  question.pose_error = 1.5;
  const SafeTime unsure = safe_time(a, Pose{}, a, Pose{{3, 0}}, {1, 0, 0}, question);
  EXPECT_EQ(unsure.after, 0.0);
  EXPECT_FALSE(unsure.hit);
}

/// The least of d / mu over all pairs of parts, without hierarchies, or longer
/// where the two can't meet however they turn; with an accepted error, no less than that leaves.
TEST(SafeTime, IsTheLeastOverAllPairsOfParts) {
  Random random(20261121);
  int apart = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<Convex> parts_a, parts_b;
    for (int i = 0; i < 12; ++i) {
      parts_a.push_back(disc(uniform(random, 0.01, 0.3), random_vec(random, 2, 2)));
      parts_b.push_back(disc(uniform(random, 0.01, 0.3), random_vec(random, 2, 2)));
    }
    const PartsBvh a = parts_bvh(parts_a), b = parts_bvh(parts_b);
    const Pose there = pose(random_vec(random, 6, 6), uniform(random, -4, 4));
    const GapRate rate{uniform(random, 0, 2), uniform(random, 0, 2),
                       trial % 3 == 0 ? 0.0 : uniform(random, 0, 9)};
    double least = kInfinity, less_rounding = kInfinity, most = kInfinity;
    for (const Convex& p : parts_a)
      for (const Convex& q : parts_b) {
        const double distance = separation(p, Pose{}, q, there).distance;
        const double mu = rate.of(p.vertices[0].norm(), q.vertices[0].norm());
        least = std::min(least, distance / mu);
        const double reaches = p.vertices[0].norm() + p.radius + q.vertices[0].norm() + q.radius;
        const double however_turned = (there.position.norm() - reaches) / rate.shift;
        most = std::min(most, std::max(distance / mu, however_turned));
        less_rounding = std::min(less_rounding, (distance - 1e-12) / mu);
      }
    const SafeTime exact = safe_time(a, Pose{}, b, there, rate, {});
    ASSERT_EQ(exact.hit, least <= 0.0) << "seed 20261121, trial " << trial;
    if (exact.hit) continue;
    ++apart;
    ASSERT_GE(exact.after, less_rounding * (1.0 - 1e-9)) << trial;
    ASSERT_LE(exact.after, most * (1.0 + 1e-9)) << trial;
    SafeTimeQuestion rough = wanting(least, least);
    rough.relative_error = 0.5;
    const SafeTime enough = safe_time(a, Pose{}, b, there, rate, rough);
    ASSERT_GE(enough.after, less_rounding / 1.5 * (1.0 - 1e-9)) << trial;
    ASSERT_FALSE(enough.hit) << trial;
  }
  EXPECT_GT(apart, 600);
  EXPECT_LT(apart, 1700);
}

TEST(SafeTime, OfOutlinesIsAHitWhereEitherHoldsTheOther) {
  const std::vector<std::vector<Vec>> large{{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}},
      small{{{0, 0}, {1, 0}, {0, 1}}};
  const auto a = outline<Box<2>>(large), b = outline<Box<2>>(small);
  EXPECT_TRUE(safe_time(a, Pose{}, b, Pose{{1, 1}}, {1, 1, 1}, {}).hit);
  EXPECT_TRUE(safe_time(b, Pose{{1, 1}}, a, Pose{}, {1, 1, 1}, {}).hit);
  EXPECT_FALSE(safe_time(b, Pose{{4, 1}}, a, Pose{}, {1, 1, 1}, {}).hit);
}

}  // namespace
}  // namespace throng::narrowphase
