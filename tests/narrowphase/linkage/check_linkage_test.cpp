// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/check_linkage.h"

#include <gtest/gtest.h>

#include <numbers>

#include "linkage_world.h"
#include "narrowphase/motion/check_motion.h"

namespace throng::narrowphase {
namespace {

TEST(CheckLinkage, BarThatSweepsOverAPostHitsIt) {
  World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
  LinkageChecker checker = world.checker();
  const LinkageAnswer hit = checker.check_motion(std::vector{0.0}, std::vector{std::numbers::pi});
  EXPECT_EQ(hit.verdict, Verdict::hit);
  EXPECT_EQ(hit.from, hit.to);
  EXPECT_NEAR(hit.from, 0.5, 0.1 / std::numbers::pi) << "the bar's end points where the post is seen";
  EXPECT_EQ(hit.pair, (LinkPair{0, kWorld}));
  EXPECT_EQ(checker.check_motion(std::vector{0.0}, std::vector{1.4}).verdict, Verdict::free);
}

TEST(CheckLinkage, BarPassesAPostAtALittleClearance) {
  for (double clearance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    World world = bar_and_post(2.0, {0.0, 2.1 + clearance}, 0.1);
    const LinkageAnswer answer =
        world.checker().check_motion(std::vector{0.0}, std::vector{std::numbers::pi});
    EXPECT_EQ(answer.verdict, Verdict::free) << clearance;
    EXPECT_LE(answer.evaluations, 7.0 / std::sqrt(clearance)) << clearance;
  }
  World world = bar_and_post(2.0, {0.0, 2.1 - 1e-6}, 0.1);
  EXPECT_EQ(world.checker().check_motion(std::vector{0.0}, std::vector{std::numbers::pi}).verdict,
            Verdict::hit);
}

TEST(CheckLinkage, ArmFoldsOntoItself) {
  World world;
  world.linkage = arm(world.shapes, 3, 1.0, 0.1);
  LinkageChecker checker = world.checker();
  const std::vector<double> straight{0, 0, 0}, bent{0, 2.0, 0}, folded{0, 2.8, 2.8};
  EXPECT_EQ(checker.check_motion(straight, bent).verdict, Verdict::free);
  const LinkageAnswer answer = checker.check_motion(straight, folded);
  EXPECT_EQ(answer.verdict, Verdict::hit);
  EXPECT_EQ(answer.pair, (LinkPair{0, 2}));
}

TEST(CheckLinkage, JointsBeforeAPairCostItNothing) {
  World world;
  world.linkage = arm(world.shapes, 4, 1.0, 0.1);
  world.pairs = {{1, 3}};
  const std::vector<double> from{0, 0, 0.3, 0.3}, to{90, 40, 0.3, 0.3};
  const LinkageAnswer answer = world.checker().check_motion(from, to);
  EXPECT_EQ(answer.verdict, Verdict::free);
  EXPECT_EQ(answer.evaluations, 1u);
}

TEST(CheckLinkage, TwoRobotsReachForEachOther) {
  World world;
  world.linkage = arm(world.shapes, 2, 1.0, 0.1);
  mount(world.linkage, arm(world.shapes, 2, 1.0, 0.1), {3.0, 0.0}, std::numbers::pi);
  LinkageChecker checker = world.checker();
  const std::vector<double> up{std::numbers::pi / 2, 0, -std::numbers::pi / 2, 0}, both{0, 0, 0, 0},
      one{0, 0, -std::numbers::pi / 2, 0};
  EXPECT_EQ(checker.check_motion(up, one).verdict, Verdict::free);
  const LinkageAnswer answer = checker.check_motion(up, both);
  EXPECT_EQ(answer.verdict, Verdict::hit);
  EXPECT_LT(answer.pair.a, 2u);
  EXPECT_GE(answer.pair.b, 2u);
}

TEST(CheckLinkage, VehicleMovesAsTheRigidBodyThatItIs) {
  Random random(12);
  int hits = 0;
  double evaluations = 0.0, of_rigid = 0.0;
  for (int i = 0; i < 200; ++i) {
    World world = random_world(random, 1);
    const PartsBvh* body = world.linkage[0].shape;
    world.linkage.assign(3, Link{});
    world.linkage[0].joint = world.linkage[1].joint = Joint::prismatic;
    world.linkage[1].parent = 0, world.linkage[2].parent = 1;
    world.linkage[1].axis = {0, 1};
    world.linkage[2].shape = body;
    const std::vector<double> from = random_values(random, 3, 6.0), to = random_values(random, 3, 6.0);
    const LinkageAnswer answer = world.checker().check_motion(from, to);
    const Motion motion{{from[0], from[1]}, from[2], {to[0] - from[0], to[1] - from[1]}, to[2] - from[2]};
    const PathAnswer rigid = check_motion(*body, motion, *world.obstacles, {}, 1.0);
    EXPECT_EQ(answer.verdict, rigid.verdict) << "seed 12, world " << i;
    evaluations += static_cast<double>(answer.evaluations);
    of_rigid += static_cast<double>(rigid.evaluations);
    hits += answer.verdict == Verdict::hit;
  }
  EXPECT_NEAR(evaluations / of_rigid, 1.0, 0.01) << "the bound is as sharp";
  EXPECT_GT(hits, 60);
  EXPECT_LT(hits, 140);
}

/// By exact separations: a hit is one, and 1,000 samples of a free motion find none.
void expect_true(const World& world, const LinkageAnswer& answer, const std::vector<double>& from,
                 const std::vector<double>& to, const std::string& what) {
  LinkageMotion motion;
  motion.reset(world.linkage, from, to);
  EXPECT_NE(answer.verdict, Verdict::undecided) << what;
  if (answer.verdict == Verdict::hit) {
    EXPECT_LE(world.distance(answer.pair, motion, answer.from), 0.0) << what;
    return;
  }
  for (const LinkPair& pair : world.pairs)
    for (int k = 0; k <= 1000; ++k) ASSERT_GT(world.distance(pair, motion, k / 1000.0), 0.0) << what;
}

TEST(CheckLinkage, IsNeverContradictedBySamplesNorByTheWayBack) {
  Random random(13);
  int hits = 0, count = 0;
  for (int i = 0; i < 300; ++i) {
    World world = random_world(random, 1 + random() % 5);
    LinkageChecker checker = world.checker();
    const std::vector<double> from = random_values(random, world.linkage.size(), 2.0);
    std::vector<double> to = from;
    for (double& q : to) q += uniform(random, -4.0, 4.0);
    if (checker.contact(from)) continue;
    const std::string what = "seed 13, world " + std::to_string(i);
    const LinkageAnswer answer = checker.check_motion(from, to), back = checker.check_motion(to, from);
    EXPECT_EQ(answer.verdict, back.verdict) << what;
    expect_true(world, answer, from, to, what);
    expect_true(world, back, to, from, what);
    hits += answer.verdict == Verdict::hit, ++count;
  }
  RecordProperty("motions", count);
  RecordProperty("hits", hits);
  EXPECT_GT(count, 80);
  EXPECT_GT(hits, 0.3 * count);
  EXPECT_LT(hits, 0.7 * count);
}

TEST(CheckLinkage, ContactAndNearestAreThoseOfAllPairs) {
  Random random(14);
  int contacts = 0;
  for (int i = 0; i < 400; ++i) {
    World world = random_world(random, 1 + random() % 4);
    LinkageChecker checker = world.checker();
    const std::vector<double> values = random_values(random, world.linkage.size(), 3.0);
    LinkageMotion motion;
    motion.reset(world.linkage, values, values);
    double least = std::numeric_limits<double>::infinity();
    for (const LinkPair& pair : world.pairs) least = std::min(least, world.distance(pair, motion, 0.0));
    const auto contact = checker.contact(values), nearest = checker.nearest(values);
    ASSERT_TRUE(nearest.has_value());
    EXPECT_NEAR(nearest->separation.distance, least, 1e-12) << "seed 14, world " << i;
    EXPECT_EQ(contact.has_value(), least <= 0.0) << "seed 14, world " << i;
    EXPECT_TRUE(!contact || contact->separation.distance <= 0.0);
    contacts += contact.has_value();
  }
  EXPECT_GT(contacts, 120);
  EXPECT_LT(contacts, 280);
}

TEST(CheckLinkage, PathIsWhatItsSegmentsAre) {
  World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
  LinkageChecker checker = world.checker();
  const std::vector<double> waypoints{0.0, 1.0, 0.5, 2.5, 3.0};
  std::vector<LinkageAnswer> answers(4);
  const LinkageAnswer all = checker.check_path(waypoints, {}, answers);
  const Verdict expected[] = {Verdict::free, Verdict::free, Verdict::hit, Verdict::free};
  std::size_t evaluations = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(answers[i].verdict, expected[i]) << i;
    evaluations += answers[i].evaluations;
  }
  EXPECT_EQ(all.verdict, Verdict::hit);
  EXPECT_EQ(all.segment, 2u);
  EXPECT_EQ(all.evaluations, evaluations);
  const LinkageAnswer any = checker.check_path(waypoints);
  EXPECT_EQ(any.verdict, Verdict::hit);
  EXPECT_EQ(any.segment, 2u);
  EXPECT_EQ(any.pair, (LinkPair{0, kWorld}));
  EXPECT_EQ(checker.check_path(std::vector{0.0, 1.0, 0.2}).verdict, Verdict::free);
}

TEST(CheckLinkage, StartInContactIsAHitAtOnce) {
  World world = bar_and_post(2.0, {1.0, 0.0}, 0.1);
  const LinkageAnswer answer = world.checker().check_motion(std::vector{0.0}, std::vector{0.01});
  EXPECT_EQ(answer.verdict, Verdict::hit);
  EXPECT_LE(answer.evaluations, 3u);
}

TEST(CheckLinkage, NoMotionIsOneQuestionAPair) {
  World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
  LinkageChecker checker = world.checker();
  const LinkageAnswer free = checker.check_motion(std::vector{0.3}, std::vector{0.3});
  EXPECT_EQ(free.verdict, Verdict::free);
  EXPECT_EQ(free.evaluations, 1u);
  EXPECT_EQ(checker.check_motion(std::vector{0.3}, std::vector{0.3 + 5e-324}).verdict, Verdict::free);
  EXPECT_EQ(
      checker.check_motion(std::vector{std::numbers::pi / 2}, std::vector{std::numbers::pi / 2}).verdict,
      Verdict::hit);
}

TEST(CheckLinkage, DenormalRatesAreFree) {
  World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
  EXPECT_EQ(world.checker().check_motion(std::vector{0.0}, std::vector{5e-324}).verdict, Verdict::free);
}

TEST(CheckLinkage, LinksOfNoLengthAreDiscsThatTurnInPlace) {
  World world;
  world.linkage.assign(5, Link{});
  for (std::uint32_t i = 1; i < 5; ++i) world.linkage[i].parent = i - 1;
  world.linkage[4].shape = world.shapes.add({disc(0.5)});
  world.obstacles = world.shapes.add({disc(0.5, {1.001, 0.0})});
  const std::vector<double> from(5, 0.0), to{3, 1, 4, 1, 5};
  EXPECT_EQ(world.checker().check_motion(from, to).verdict, Verdict::free);
}

TEST(CheckLinkage, WithoutPairsEverythingIsFree) {
  World world;
  world.linkage.assign(2, Link{});
  LinkageChecker checker({world.linkage, {}, nullptr});
  EXPECT_EQ(checker.check_motion(std::vector{0.0, 1.0}, std::vector{1.0, 1.0}).verdict, Verdict::free);
  EXPECT_FALSE(checker.contact(std::vector{0.0, 1.0}).has_value());
  EXPECT_FALSE(checker.nearest(std::vector{0.0, 1.0}).has_value());
}

TEST(CheckLinkage, AHundredTurnsPastAPostAreFree) {
  World world = bar_and_post(2.0, {0.0, 2.5}, 0.1);
  const LinkageAnswer answer =
      world.checker().check_motion(std::vector{0.0}, std::vector{100 * 2.0 * std::numbers::pi});
  EXPECT_EQ(answer.verdict, Verdict::free);
}

TEST(CheckLinkage, AnswersTheSameAgain) {
  Random random(15);
  World world = random_world(random, 5);
  LinkageChecker checker = world.checker(), fresh = world.checker();
  const std::vector<double> from = random_values(random, 5, 1.0), to = random_values(random, 5, 1.0);
  const std::vector<double> longer = random_values(random, 50, 1.0);
  const LinkageAnswer once = checker.check_motion(from, to);
  checker.check_path(longer);
  const LinkageAnswer again = checker.check_motion(from, to), other = fresh.check_motion(from, to);
  EXPECT_EQ(once.evaluations, again.evaluations);
  EXPECT_EQ(once.from, again.from);
  EXPECT_EQ(once.evaluations, other.evaluations);
}

/// Beyond its limits a linkage may meet itself where nobody looks.
TEST(CheckLinkageDeathTest, ExpectsMotionsWithinTheLimits) {
  World world = bar_and_post(2.0, {0.0, 5.0}, 0.1);
  world.linkage[0].lower = -1.0, world.linkage[0].upper = 1.0;
  LinkageChecker checker = world.checker();
  const std::vector<double> within{1.0}, beyond{1.1}, path{0.0, 1.0, 1.1};
  EXPECT_EQ(checker.check_motion(within, within).verdict, Verdict::free);
  EXPECT_DEBUG_DEATH(checker.check_motion(within, beyond), "beyond_limits");
  EXPECT_DEBUG_DEATH(checker.check_motion(beyond, within), "beyond_limits");
  EXPECT_DEBUG_DEATH(checker.check_path(path), "beyond_limits");
  EXPECT_DEBUG_DEATH(checker.first_contact(within, beyond), "beyond_limits");
}

}  // namespace
}  // namespace throng::narrowphase
