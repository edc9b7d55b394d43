// SPDX-License-Identifier: MIT
#include "narrowphase/motion/safe_time.h"

#include <gtest/gtest.h>

#include <limits>

#include "moving_solids.h"

namespace throng::narrowphase {
namespace {

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
  EXPECT_EQ(safe_time(a, Pose{}, a, Pose{{3, 0}}, {0, 0, 0}, {}).after,
            std::numeric_limits<double>::infinity());
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
    double least = std::numeric_limits<double>::infinity(), less_rounding = least, most = least;
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

/// Of one pair of parts, each alone in its leaf.
ClearTime definition(const Convex& p, const Pose& pose_p, const Convex& q, const Pose& pose_q,
                     const GapRate& rate, const RelativeMotion& motion, const ClearTime& wanted) {
  const auto far = [](const Convex& c) {
    double most = 0.0;
    for (const Vec& v : c.vertices) most = std::max(most, v.norm());
    return most;
  };
  const Separation apart = separation(p, pose_p, q, pose_q);
  const double straight = apart.distance / rate.of(far(p), far(q));
  const OpenGap gap{
      {p.vertices, pose_p, far(p)}, {q.vertices, pose_q, far(q)}, apart.normal, p.radius + q.radius};
  return longer({straight, straight}, clear_time(gap, motion, wanted));
}

/// Of scenes of a dozen shapes, both of which move: no less than what an accepted error of a half leaves of
/// the least over all pairs of parts, and never beyond a contact.
TEST(SafeTime, OfMovingScenesIsWithinTheAcceptedErrorOfTheDefinition) {
  constexpr std::uint64_t kSeed = 20261122;
  Random random(kSeed);
  int apart = 0, rough = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    std::vector<Convex> parts_a, parts_b;
    for (std::vector<Convex>* parts : {&parts_a, &parts_b})
      for (int i = 0; i < 12; ++i) {
        Convex part = scaled(random_shape(random, 1.0), 0.2);
        const Vec at = random_vec(random, 2, 2);
        for (Vec& v : part.vertices) v += at;
        parts->push_back(std::move(part));
      }
    const PartsBvh a = parts_bvh(parts_a), b = parts_bvh(parts_b);
    Motion motion_a = random_motion(random), motion_b = random_motion(random);
    motion_b.position += random_vec(random, 4, 4);
    const double now = 0.5;
    const Pose pose_a = pose_at(motion_a, now), pose_b = pose_at(motion_b, now);
    const GapRate rate = gap_rate(motion_a, motion_b);
    const RelativeMotion motion{motion_a.spin, motion_b.spin, motion_b.velocity - motion_a.velocity,
                                rate.shift};
    SafeTimeQuestion question = wanting(0.5, 0.5);
    question.motion = &motion, question.relative_error = 0.5;
    const SafeTime found = safe_time(a, pose_a, b, pose_b, rate, question);
    const bool touching = separation(a, pose_a, b, pose_b).distance <= 0.0;
    ASSERT_EQ(found.hit, touching) << "seed " << kSeed << ", trial " << trial;
    if (touching) continue;
    ++apart;
    ClearTime least{0.5, 0.5};
    for (const Convex& p : parts_a)
      for (const Convex& q : parts_b)
        least = shorter(least, definition(p, pose_a, q, pose_b, rate, motion, {0.5, 0.5}));
    ASSERT_GE(found.before, least.before / 1.5 * (1.0 - 1e-6)) << "seed " << kSeed << ", trial " << trial;
    ASSERT_GE(found.after, least.after / 1.5 * (1.0 - 1e-6)) << "seed " << kSeed << ", trial " << trial;
    rough += found.before < 0.999 * least.before || found.after < 0.999 * least.after;
    const double before = std::min(0.5, found.before), after = std::min(0.5, found.after);
    for (int i = 0; i <= 20; ++i) {
      const double t = now - before + (before + after) * i / 20.0;
      ASSERT_GT(separation(a, pose_at(motion_a, t), b, pose_at(motion_b, t)).distance, 0.0)
          << "seed " << kSeed << ", trial " << trial << ", time " << t;
    }
  }
  EXPECT_GT(apart, 400);
  EXPECT_LT(apart, 1400);
  EXPECT_GT(rough, 20) << "the accepted error is used";
}

/// Two squares 1 m apart, of which one comes at 1 m/s: distances over rates, and parabolas.
TEST(SafeTime, OfOutlinesLeavesOutWhatPosesMayBeOffBy) {
  const std::vector<std::vector<Vec>> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const auto a = outline<BoxAndBall<2>>(square);
  const RelativeMotion motion{0.0, 0.0, {-1, 0}, 1.0};
  for (const RelativeMotion* known : {static_cast<const RelativeMotion*>(nullptr), &motion}) {
    SafeTimeQuestion question = wanting(2.0, 2.0);
    question.motion = known;
    question.pose_error = 0.25;
    EXPECT_NEAR(safe_time(a, Pose{}, a, Pose{{2, 0.5}}, {1, 0, 0}, question).after, 0.75, 1e-12);
    question.pose_error = 1.5;
    const SafeTime unsure = safe_time(a, Pose{}, a, Pose{{2, 0.5}}, {1, 0, 0}, question);
    EXPECT_EQ(unsure.after, 0.0);
    EXPECT_FALSE(unsure.hit);
  }
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
