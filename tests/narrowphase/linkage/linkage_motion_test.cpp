// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/linkage_motion.h"

#include <gtest/gtest.h>

#include "random_linkage.h"

namespace throng::narrowphase {
namespace {

GapRate rate(const Linkage& linkage, const LinkPair& pair, std::vector<double> from, std::vector<double> to) {
  LinkageMotion motion;
  motion.reset(linkage, from, to);
  return motion.bounds(pair).rate;
}

TEST(LinkageRate, OfOneLinkIsThatOfARigidBodyThatTurns) {
  ShapeStore shapes;
  const GapRate r = rate(arm(shapes, 1, 2.0, 0.0), {0, kWorld}, {0.1}, {0.6});
  EXPECT_EQ(r.shift, 0.0);
  EXPECT_EQ(r.turn_a, 0.5);
  EXPECT_EQ(r.of(2.0, 7.0), 1.0);
}

TEST(LinkageRate, OpposedJointsCancel) {
  ShapeStore shapes;
  const Linkage robot = arm(shapes, std::vector<double>{1.0, 0.8}, 0.0);
  const std::vector<double> from{0, 0}, to{0.6, -0.9};
  EXPECT_NEAR(textbook(robot, 1, kWorld, 0.8, from, to), 1.8, 1e-15);
  EXPECT_NEAR(rate(robot, {1, kWorld}, from, to).of(0.8, 0.0), 0.84, 1e-12);
}

TEST(LinkageRate, OfAPrismaticJointIsItsTranslation) {
  Linkage robot(1);
  robot[0].joint = Joint::prismatic;
  const GapRate r = rate(robot, {0, kWorld}, {1}, {-2});
  EXPECT_NEAR(r.shift, 3.0, 1e-12);
  EXPECT_EQ(r.turn_a, 0.0);
}

TEST(LinkageRate, OfAVehicleIsThatOfARigidBody) {
  Linkage robot(3);
  robot[0].joint = robot[1].joint = Joint::prismatic;
  robot[1].parent = 0, robot[2].parent = 1;
  robot[1].axis = {0, 1};
  const GapRate r = rate(robot, {2, kWorld}, {0, 0, 0}, {3, 4, 2});
  EXPECT_NEAR(r.shift, 5.0, 1e-12) << "not 3 + 4";
  EXPECT_EQ(r.turn_a, 2.0);
}

TEST(LinkageRate, OfAnArmThatIsStretchedTakesTheLongestThatItGets) {
  Linkage robot(2);
  robot[1] = {nullptr, 0, Joint::prismatic, {1, 0}, 0.0, {1, 0}};
  EXPECT_NEAR(rate(robot, {1, kWorld}, {0, 0}, {1, 3}).shift, 5.0, 1e-12) << "4 across and 3 along";
  EXPECT_NEAR(rate(robot, {1, kWorld}, {0, 3}, {1, 0}).shift, 5.0, 1e-12);
}

TEST(LinkageRate, OfAStiffJointBetweenTwoArmsTakesThemAsOne) {
  ShapeStore shapes;
  const Linkage robot = arm(shapes, 3, 1.0, 0.0);
  const GapRate bent = rate(robot, {2, kWorld}, {0, std::numbers::pi / 2, 0}, {1, std::numbers::pi / 2, 1});
  EXPECT_NEAR(bent.shift, std::sqrt(2.0), 1e-12) << "not 1 + 1";
}

TEST(LinkageRate, BetweenTwoLinksLeavesOutTheJointsBeforeThem) {
  ShapeStore shapes;
  const Linkage robot = arm(shapes, 4, 1.0, 0.0);
  const GapRate r = rate(robot, {1, 3}, {0, 0, 0, 0}, {9, -7, 0, 0});
  EXPECT_EQ(r.of(1.0, 1.0), 0.0);
  const GapRate last = rate(robot, {1, 3}, {0, 0, 0, 0}, {9, -7, 0, 0.5});
  EXPECT_NEAR(last.of(1.0, 1.0), 0.5, 1e-12);
}

TEST(LinkageRate, BetweenTwoRobotsThatTurnAlikeIsWhatTheirBasesDoSeenByThem) {
  ShapeStore shapes;
  Linkage both = arm(shapes, 1, 1.0, 0.0);
  mount(both, arm(shapes, 1, 1.0, 0.0), {0.5, 0.0}, 0.0);
  EXPECT_NEAR(rate(both, {0, 1}, {0, 0}, {1, 1}).of(1.0, 1.0), 0.5, 1e-12) << "not 1 + 1";
}

TEST(LinkageRate, OfNoMotionIsNothing) {
  Random random(11);
  ShapeStore shapes;
  const Linkage forest = random_forest(random, shapes, 10);
  const std::vector<double> values = random_values(random, 10, 3.0);
  for (std::uint32_t a = 0; a < 10; ++a)
    for (std::uint32_t b : {a == 0 ? 1u : 0u, kWorld})
      EXPECT_EQ(rate(forest, {a, b}, values, values).of(1e3, b == kWorld ? 0.0 : 1e3), 0.0);
}

struct Sharpness {
  double sharp = 0.0, book = 0.0, steepest = 0.0;
};

/// Against points of the two links, or of the world: how fast their distance changes between two instants
/// never exceeds the rate, and the rate never exceeds the textbook's.
Sharpness measure(const Linkage& linkage, const LinkPair& pair, Random& random, const std::string& what) {
  const std::vector<double> from = random_values(random, linkage.size(), 2.0);
  const std::vector<double> to = random_values(random, linkage.size(), 2.0);
  LinkageMotion motion;
  motion.reset(linkage, from, to);
  const double radius_a = reach(linkage[pair.a]), radius_b = pair.b == kWorld ? 0.0 : reach(linkage[pair.b]);
  const std::uint32_t top = nearest_common_ancestor(linkage, pair);
  Sharpness s{motion.bounds(pair).rate.of(radius_a, radius_b), 0.0, 0.0};
  for (const auto& [end, radius] : {std::pair(pair.a, radius_a), std::pair(pair.b, radius_b)})
    s.book += textbook(linkage, end, top, radius, from, to);
  EXPECT_LE(s.sharp, s.book * (1.0 + 1e-9)) << what;
  for (int i = 0; i < 100; ++i) {
    const double t = uniform(random, 0.0, 0.999), dt = 1e-4;
    const Vec p = pose({0, 0}, uniform(random, -4, 4)).rotate({radius_a, 0});
    const Vec q = pair.b == kWorld ? random_vec(random, 9.0, 9.0)
                                   : pose({0, 0}, uniform(random, -4, 4)).rotate({radius_b, 0});
    const auto gap = [&](double time) {
      return (motion.pose(pair.b, time) * q - motion.pose(pair.a, time) * p).norm();
    };
    const double steep = std::abs(gap(t + dt) - gap(t)) / dt;
    EXPECT_LE(steep, s.sharp * (1.0 + 1e-9) + 1e-9) << what;
    s.steepest = std::max(s.steepest, steep);
  }
  return s;
}

TEST(LinkageRate, IsNeverExceededNorExceedsTheTextbook) {
  Random random(5);
  double tightest = 0.0;
  int much_sharper = 0;
  for (int i = 0; i < 500; ++i) {
    ShapeStore shapes;
    const Linkage forest = random_forest(random, shapes, 2 + random() % 9);
    const auto a = static_cast<std::uint32_t>(random() % forest.size());
    const auto b = static_cast<std::uint32_t>(random() % forest.size());
    const LinkPair pair{std::min(a, b), a == b ? kWorld : std::max(a, b)};
    const Sharpness s = measure(forest, pair, random, "seed 5, forest " + std::to_string(i));
    if (s.sharp > 0.0) tightest = std::max(tightest, s.steepest / s.sharp);
    much_sharper += s.sharp < 0.7 * s.book;
  }
  EXPECT_GT(tightest, 0.95) << "the sample comes near the bound";
  EXPECT_GT(much_sharper, 100);
}

/// Where b's origin is relative to a's, seen by who turns at `seen_by` since `now`, and stands as their
/// common ancestor then.
Vec relative_offset(const LinkageMotion& motion, const LinkPair& pair, std::uint32_t ancestor, double seen_by,
                    double now, double time) {
  const Vec between = motion.pose(pair.b, time).position - motion.pose(pair.a, time).position;
  const Vec upright = pose({0, 0}, seen_by * (time - now)).unrotate(between);
  return motion.pose(ancestor, now).unrotate(upright);
}

TEST(LinkageInstant, HasTheVelocityAndBoundsTheAcceleration) {
  Random random(10);
  double tightest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    ShapeStore shapes;
    const Linkage forest = random_forest(random, shapes, 2 + random() % 6);
    const std::vector<double> from = random_values(random, forest.size(), 2.0);
    const std::vector<double> to = random_values(random, forest.size(), 2.0);
    const auto a = static_cast<std::uint32_t>(random() % (forest.size() - 1));
    const LinkPair pair{a, random() % 3 == 0 ? kWorld : static_cast<std::uint32_t>(forest.size() - 1)};
    LinkageMotion motion;
    motion.reset(forest, from, to);
    const PairBounds bounds = motion.bounds(pair);
    const std::uint32_t ancestor = nearest_common_ancestor(forest, pair);
    const double t = uniform(random, 0.1, 0.9), dt = 1e-4;
    const LinkageMotion::Instant now = motion.at(pair, bounds, t);
    const Vec before = relative_offset(motion, pair, ancestor, bounds.seen_by, t, t - dt);
    const Vec at = relative_offset(motion, pair, ancestor, bounds.seen_by, t, t);
    const Vec after = relative_offset(motion, pair, ancestor, bounds.seen_by, t, t + dt);
    const std::string what = "seed 10, forest " + std::to_string(i);
    EXPECT_LE((now.b.position - now.a.position - at).norm(), 1e-12) << what;
    EXPECT_LE(((after - before) / (2 * dt) - now.motion.velocity).norm(), 1e-5) << what;
    const double bent = ((after - 2 * at + before) / (dt * dt)).norm();
    EXPECT_LE(bent, bounds.acceleration + 1e-4) << what;
    EXPECT_LE(now.motion.velocity.norm(), now.motion.speed * (1 + 1e-9) + 1e-12) << what;
    if (bounds.acceleration > 0.1) tightest = std::max(tightest, bent / bounds.acceleration);
  }
  EXPECT_GT(tightest, 0.95);
}

TEST(LinkageRate, IsSharperTheLongerTheArm) {
  Random random(6);
  for (std::size_t links : {2u, 4u, 10u}) {
    ShapeStore shapes;
    const Linkage robot = arm(shapes, links, 1.0, 0.0);
    double of_tip = 0.0, of_ends = 0.0;
    for (int i = 0; i < 300; ++i) {
      const auto last = static_cast<std::uint32_t>(links - 1);
      const Sharpness tip = measure(robot, {last, kWorld}, random, "seed 6");
      const Sharpness ends = measure(robot, {0, last}, random, "seed 6");
      of_tip += tip.sharp / tip.book / 300, of_ends += ends.book > 0.0 ? ends.sharp / ends.book / 300 : 0.0;
    }
    RecordProperty("tip_against_obstacles_" + std::to_string(links), std::to_string(of_tip));
    RecordProperty("tip_against_first_link_" + std::to_string(links), std::to_string(of_ends));
    EXPECT_LT(of_tip, links == 2 ? 0.9 : links == 4 ? 0.7 : 0.5);
    EXPECT_LT(of_ends, links == 2 ? 1.0 : links == 4 ? 0.8 : 0.6);
  }
}

TEST(LinkageMotion, PlacesOneLinkAsItPlacesAll) {
  Random random(7);
  ShapeStore shapes;
  const Linkage forest = random_forest(random, shapes, 9);
  LinkageMotion motion;
  motion.reset(forest, random_values(random, 9, 3.0), random_values(random, 9, 3.0));
  std::vector<Pose> poses(9);
  motion.place(0.3, poses);
  for (std::uint32_t i = 0; i < 9; ++i) {
    const Pose one = motion.pose(i, 0.3);
    EXPECT_EQ(one.position, poses[i].position);
    EXPECT_EQ(one.cos, poses[i].cos);
    EXPECT_EQ(one.sin, poses[i].sin);
  }
}

TEST(LinkageMotion, EndsWhereTheConfigurationsAreWithinItsSlack) {
  Random random(8);
  for (int i = 0; i < 300; ++i) {
    ShapeStore shapes;
    const Linkage forest = random_forest(random, shapes, 9);
    const double size = i % 2 ? 3.0 : 1e6;
    const std::vector<double> from = random_values(random, 9, size), to = random_values(random, 9, size);
    LinkageMotion motion;
    motion.reset(forest, from, to);
    std::vector<Pose> poses(9);
    for (const auto& [time, values] : {std::pair(0.0, &from), std::pair(1.0, &to)}) {
      place_links(forest, *values, poses);
      for (std::uint32_t k = 0; k < 9; ++k) {
        const Vec tip{reach(forest[k]), 0};
        EXPECT_LE((motion.pose(k, time) * tip - poses[k] * tip).norm(), motion.slack())
            << "seed 8, forest " << i;
      }
    }
    EXPECT_LE(motion.slack(), 1e-12 * size * size) << "and that is little: arms and angles of that size";
  }
}

}  // namespace
}  // namespace throng::narrowphase
