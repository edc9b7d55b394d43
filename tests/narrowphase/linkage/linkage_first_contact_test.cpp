// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "linkage_world.h"

namespace throng::narrowphase {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(LinkageFirstContact, BarMeetsTheNearSideOfAPost) {
  World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
  const LinkageAnswer answer = world.checker().first_contact(std::vector{0.0}, std::vector{kPi});
  const double exact = 0.5 - std::asin(0.1) / kPi;
  EXPECT_EQ(answer.verdict, Verdict::hit);
  EXPECT_LE(answer.from, exact);
  EXPECT_GE(answer.to, exact);
  EXPECT_LE(answer.to - answer.from, 1e-11);
  EXPECT_LE(answer.evaluations, 20u);
}

TEST(LinkageFirstContact, SliderMeetsAWallWhereItStands) {
  World world;
  world.linkage.assign(1, Link{});
  world.linkage[0].joint = Joint::prismatic;
  world.linkage[0].shape = world.shapes.add({disc(0.5)});
  world.obstacles = world.shapes.add({segment({3.0, -1.0}, {3.0, 1.0})});
  const LinkageAnswer answer = world.checker().first_contact(std::vector{0.0}, std::vector{4.0}, 1e-12);
  EXPECT_EQ(answer.verdict, Verdict::hit);
  EXPECT_LE(answer.from, 0.625);
  EXPECT_GE(answer.to, 0.625 - 1e-16);
  EXPECT_LE(answer.to - answer.from, 1e-12);
}

TEST(LinkageFirstContact, TheFirstOfTwoPostsIsToldWhicheverIsAskedFirst) {
  for (bool swapped : {false, true}) {
    World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
    std::vector<Convex> posts{disc(0.1, {0.0, 1.0}), disc(0.1, {1.0, 1.0})};
    if (swapped) std::swap(posts[0], posts[1]);
    world.obstacles = world.shapes.add(posts);
    const LinkageAnswer answer = world.checker().first_contact(std::vector{0.0}, std::vector{kPi});
    EXPECT_NEAR(answer.to, 0.25 - std::asin(0.1 / std::sqrt(2.0)) / kPi, 1e-10);
    EXPECT_EQ(answer.part_b, swapped ? 0u : 1u);
  }
}

TEST(LinkageFirstContact, TheFasterOfTwoRobotsIsTold) {
  World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
  const Linkage bar = world.linkage;
  mount(world.linkage, bar, {0.0, 0.0}, 0.0);
  world.pairs = {{0, kWorld}, {1, kWorld}};
  const LinkageAnswer answer =
      world.checker().first_contact(std::vector{0.0, 0.0}, std::vector{kPi, 2 * kPi});
  EXPECT_EQ(answer.pair, (LinkPair{1, kWorld}));
  EXPECT_NEAR(answer.to, 0.25 - std::asin(0.1) / (2 * kPi), 1e-10);
}

TEST(LinkageFirstContact, GrazingPathsAreFreeOrHitAsTheyAre) {
  for (double clearance : {1e-3, 1e-6, 1e-9}) {
    World passes = bar_and_post(2.0, {0.0, 2.1 + clearance}, 0.1);
    const LinkageAnswer free = passes.checker().first_contact(std::vector{0.0}, std::vector{kPi});
    EXPECT_EQ(free.verdict, Verdict::free) << clearance;
    World meets = bar_and_post(2.0, {0.0, 2.1 - clearance}, 0.1);
    const LinkageAnswer hit = meets.checker().first_contact(std::vector{0.0}, std::vector{kPi});
    EXPECT_EQ(hit.verdict, Verdict::hit) << clearance;
    EXPECT_LE(free.evaluations + hit.evaluations, 200u) << clearance;
  }
}

TEST(LinkageFirstContact, StandsAtZeroWhereTheStartTouches) {
  World world = bar_and_post(2.0, {1.0, 0.0}, 0.1);
  for (double to : {0.0, 1.0}) {
    const LinkageAnswer answer = world.checker().first_contact(std::vector{0.0}, std::vector{to});
    EXPECT_EQ(answer.verdict, Verdict::hit);
    EXPECT_EQ(answer.to, 0.0);
    EXPECT_EQ(answer.evaluations, 1u);
  }
}

TEST(LinkageFirstContact, NoMotionIsFreeAtOnce) {
  World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
  const LinkageAnswer answer = world.checker().first_contact(std::vector{0.3}, std::vector{0.3});
  EXPECT_EQ(answer.verdict, Verdict::free);
  EXPECT_EQ(answer.evaluations, 1u);
}

/// Of all pairs, over 1,000 instants before `time`.
bool touches_before(const World& world, const LinkageMotion& motion, double time) {
  for (const LinkPair& pair : world.pairs)
    for (int k = 0; k < 1000; ++k)
      if (world.distance(pair, motion, k / 1000.0 * time) <= 0.0) return true;
  return false;
}

TEST(LinkageFirstContact, IsWhereNothingTouchesBeforeAndThePairDoes) {
  Random random(16);
  int hits = 0, count = 0;
  for (int i = 0; i < 300; ++i) {
    World world = random_world(random, 1 + random() % 5);
    LinkageChecker checker = world.checker();
    const std::vector<double> from = random_values(random, world.linkage.size(), 2.0);
    const std::vector<double> to = random_values(random, world.linkage.size(), 4.0);
    if (checker.contact(from)) continue;
    const std::string what = "seed 16, world " + std::to_string(i);
    const LinkageAnswer first = checker.first_contact(from, to);
    LinkageMotion motion;
    motion.reset(world.linkage, from, to);
    ++count;
    EXPECT_EQ(first.verdict, checker.check_motion(from, to).verdict) << what;
    EXPECT_FALSE(touches_before(world, motion, first.verdict == Verdict::hit ? first.from : 1.0)) << what;
    if (first.verdict != Verdict::hit) continue;
    ++hits;
    EXPECT_LE(world.distance(first.pair, motion, first.to), 0.0) << what;
    EXPECT_LE(first.to - first.from, 1e-8) << what;
  }
  RecordProperty("motions", count);
  RecordProperty("hits", hits);
  EXPECT_GT(count, 80);
  EXPECT_GT(hits, 0.3 * count);
  EXPECT_LT(hits, 0.7 * count);
}

}  // namespace
}  // namespace throng::narrowphase
