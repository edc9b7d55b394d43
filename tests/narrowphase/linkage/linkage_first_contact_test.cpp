// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linkage_world.h"

namespace throng::narrowphase {
namespace {

TEST(LinkageFirstContact, BarMeetsTheNearSideOfAPost) {
  World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
  const LinkageAnswer answer = world.checker().first_contact(std::vector{0.0}, std::vector{std::numbers::pi});
  const double exact = 0.5 - std::asin(0.1) / std::numbers::pi;
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
    const LinkageAnswer answer =
        world.checker().first_contact(std::vector{0.0}, std::vector{std::numbers::pi});
    EXPECT_NEAR(answer.to, 0.25 - std::asin(0.1 / std::sqrt(2.0)) / std::numbers::pi, 1e-10);
    EXPECT_EQ(answer.part_b, swapped ? 0u : 1u);
  }
}

TEST(LinkageFirstContact, TheFasterOfTwoRobotsIsTold) {
  World world = bar_and_post(2.0, {0.0, 1.0}, 0.1);
  const Linkage bar = world.linkage;
  mount(world.linkage, bar, {0.0, 0.0}, 0.0);
  world.pairs = {{0, kWorld}, {1, kWorld}};
  const LinkageAnswer answer = world.checker().first_contact(
      std::vector{0.0, 0.0}, std::vector{std::numbers::pi, 2 * std::numbers::pi});
  EXPECT_EQ(answer.pair, (LinkPair{1, kWorld}));
  EXPECT_NEAR(answer.to, 0.25 - std::asin(0.1) / (2 * std::numbers::pi), 1e-10);
}

/// Discs of radius 0.5, each on a track of its own that ends at a wall.
World sliders(const std::vector<double>& walls) {
  World world;
  std::vector<Convex> solid;
  for (std::uint32_t k = 0; k < walls.size(); ++k) {
    const double track = 10.0 * k;
    Link slider;
    slider.joint = Joint::prismatic, slider.at = {0.0, track};
    slider.shape = world.shapes.add({disc(0.5)});
    world.linkage.push_back(slider);
    world.pairs.push_back({k, kWorld});
    solid.push_back(segment({walls[k], track - 1.0}, {walls[k], track + 1.0}));
  }
  world.obstacles = world.shapes.add(std::move(solid));
  return world;
}

TEST(LinkageFirstContact, SecondHitWithinTheFirstsWidthDoesNotMakeItsBeginningCertain) {
  for (bool swapped : {false, true}) {
    std::vector<double> walls{3.0, 3.002};  // met at 0.625 and at 0.6255
    if (swapped) std::swap(walls[0], walls[1]);
    World world = sliders(walls);
    const LinkageAnswer answer =
        world.checker().first_contact(std::vector{0.0, 0.0}, std::vector{4.0, 4.0}, 0.01);
    EXPECT_EQ(answer.verdict, Verdict::hit);
    EXPECT_LE(answer.from, 0.625) << (swapped ? "the later first" : "the earlier first");
    EXPECT_GE(answer.to, 0.625);
    EXPECT_LE(answer.to - answer.from, 0.01 / 4.0 + 1e-15);
  }
}

TEST(LinkageFirstContact, BeginsBeforeEachPairsOwnContact) {
  Random random(18);
  int close = 0;
  for (int i = 0; i < 300; ++i) {
    const double width = i % 2 ? 1e-2 : 0.0, spread = i % 2 ? 1e-2 : 1e-12;
    std::vector<double> walls;
    while (walls.size() < 4) walls.push_back(3.0 + uniform(random, 0.0, spread));
    World world = sliders(walls);
    const std::vector<double> from(4, 0.0), to(4, 4.0);
    const LinkageAnswer first = world.checker().first_contact(from, to, width);
    double least_from = 1.0, least_to = 1.0;
    for (const LinkPair& pair : world.pairs) {
      const LinkageAnswer alone =
          LinkageChecker({world.linkage, {&pair, 1}, world.obstacles}).first_contact(from, to, width);
      least_from = std::min(least_from, alone.from), least_to = std::min(least_to, alone.to);
    }
    const double contact = (*std::min_element(walls.begin(), walls.end()) - 0.5) / 4.0;
    EXPECT_LE(first.from, std::nextafter(contact, 1.0)) << "seed 18, world " << i;
    EXPECT_GE(first.to, std::nextafter(contact, 0.0)) << "seed 18, world " << i;
    EXPECT_LE(first.to, least_to) << "seed 18, world " << i;
    close += first.from <= least_from;
  }
  EXPECT_GT(close, 290) << "mostly the earliest that one of them is known to be free up to";
}

TEST(LinkageFirstContact, GrazingPathsAreFreeOrHitAsTheyAre) {
  for (double clearance : {1e-3, 1e-6, 1e-9}) {
    World passes = bar_and_post(2.0, {0.0, 2.1 + clearance}, 0.1);
    const LinkageAnswer free =
        passes.checker().first_contact(std::vector{0.0}, std::vector{std::numbers::pi});
    EXPECT_EQ(free.verdict, Verdict::free) << clearance;
    World meets = bar_and_post(2.0, {0.0, 2.1 - clearance}, 0.1);
    const LinkageAnswer hit = meets.checker().first_contact(std::vector{0.0}, std::vector{std::numbers::pi});
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

/// A disc that slides past others by less than rounding tells from touching.
TEST(LinkageFirstContact, TellsTheFirstDoubtAndNoHitWithoutIt) {
  World world;
  world.linkage.assign(1, Link{});
  world.linkage[0].joint = Joint::prismatic;
  world.linkage[0].shape = world.shapes.add({disc(0.5)});
  std::vector<Convex> posts{disc(0.5, {3.0, std::nextafter(1.0, 2.0)}),
                            disc(0.5, {4.5, std::nextafter(1.0, 2.0)})};
  for (const bool wall : {false, true}) {
    if (wall) posts.push_back(segment({5.75, -1.0}, {5.75, 0.25}));
    world.obstacles = world.shapes.add(posts);
    const LinkageAnswer answer = world.checker().first_contact(std::vector{0.0}, std::vector{6.0});
    EXPECT_EQ(answer.verdict, wall ? Verdict::hit : Verdict::undecided);
    EXPECT_NEAR(answer.from, 0.5, 1e-6);
    EXPECT_NEAR(answer.to, wall ? 5.25 / 6.0 : 0.5, 1e-6);
  }
}

/// Past 4,000 points a millimetre apart, 1e-8 m from each: 10,000 evaluations end on the way, and what comes
/// behind them, a post that is hit, isn't known.
TEST(LinkageFirstContact, NeverCallsFreeWhatItGaveUp) {
  World world;
  world.linkage.assign(1, Link{});
  world.linkage[0].joint = Joint::prismatic;
  world.linkage[0].shape = world.shapes.add({disc(0.5)});
  std::vector<Convex> points;
  for (int i = 0; i < 4000; ++i) points.push_back(disc(0.0, {1.0 + 1e-3 * i, 0.5 + 1e-8}));
  points.push_back(disc(0.1, {6.0, 0.0}));
  world.obstacles = world.shapes.add(std::move(points));
  const LinkageAnswer answer = world.checker().first_contact(std::vector{0.0}, std::vector{8.0});
  EXPECT_EQ(answer.verdict, Verdict::undecided);
  EXPECT_GT(answer.from, 1.0 / 8.0);
  EXPECT_LT(answer.from, 5.0 / 8.0);
  EXPECT_EQ(answer.to, 1.0);
  EXPECT_EQ(answer.pair, (LinkPair{0, kWorld}));
  EXPECT_EQ(answer.evaluations, 10001u);
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
