// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/link_pairs.h"

#include <gmock/gmock.h>

#include "random_linkage.h"

namespace throng::narrowphase {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(PairsToCheck, LeavesOutLinksThatShareAJoint) {
  ShapeStore shapes;
  const Linkage robot = arm(shapes, 4, 1.0, 0.1);
  EXPECT_THAT(pairs_to_check(robot, false), ElementsAre(LinkPair{0, 2}, LinkPair{0, 3}, LinkPair{1, 3}));
}

TEST(PairsToCheck, AsksObstaclesFirst) {
  ShapeStore shapes;
  EXPECT_THAT(pairs_to_check(arm(shapes, 2, 1.0, 0.1), true),
              ElementsAre(LinkPair{0, kWorld}, LinkPair{1, kWorld}));
}

TEST(PairsToCheck, LeavesOutWhatMayTouch) {
  ShapeStore shapes;
  const Linkage robot = arm(shapes, 4, 1.0, 0.1);
  const std::vector<LinkPair> may_touch{{3, 0}, {kWorld, 0}, {1, kWorld}};
  EXPECT_THAT(pairs_to_check(robot, true, may_touch),
              ElementsAre(LinkPair{2, kWorld}, LinkPair{3, kWorld}, LinkPair{0, 2}, LinkPair{1, 3}));
}

TEST(PairsToCheck, LeavesOutLinksWithoutShape) {
  ShapeStore shapes;
  Linkage robot = arm(shapes, 3, 1.0, 0.1);
  robot[2].shape = nullptr;
  EXPECT_THAT(pairs_to_check(robot, true), ElementsAre(LinkPair{0, kWorld}, LinkPair{1, kWorld}));
}

TEST(PairsToCheck, TwoRobotsMayMeet) {
  ShapeStore shapes;
  Linkage both = arm(shapes, 1, 1.0, 0.1);
  mount(both, arm(shapes, 1, 1.0, 0.1), {1.5, 0.0}, 0.0);
  EXPECT_THAT(pairs_to_check(both, false), ElementsAre(LinkPair{0, 1}));
}

TEST(PairsToCheck, BarMayMeetAPostThatIsARobotOfItsOwn) {
  ShapeStore shapes;
  Linkage post(1);
  post[0].shape = shapes.add({disc(0.1)}), post[0].lower = post[0].upper = 0.0;
  for (bool post_first : {false, true}) {
    Linkage both = post_first ? Linkage{} : arm(shapes, 1, 2.0, 0.1);
    mount(both, post, {0.0, 1.0}, 0.0);
    if (post_first) mount(both, arm(shapes, 1, 2.0, 0.1), {0.0, 0.0}, 0.0);
    EXPECT_THAT(pairs_to_check(both, false), ElementsAre(LinkPair{0, 1})) << post_first;
    EXPECT_THAT(pairs_to_check(both, false, std::vector<LinkPair>{{1, 0}}), IsEmpty()) << post_first;
  }
}

TEST(PairsToCheck, RobotsThatStandStillAreAskedWhereTheyTouch) {
  ShapeStore shapes;
  Linkage post(1), all;
  post[0].shape = shapes.add({disc(0.5)}), post[0].lower = post[0].upper = 0.0;
  for (double at : {0.0, 0.9, 3.0}) mount(all, post, {at, 0.0}, 0.0);
  EXPECT_THAT(pairs_to_check(all, false), ElementsAre(LinkPair{0, 1}));
}

TEST(PairsToCheck, LinksOnOneFootShareItsJoint) {
  ShapeStore shapes;
  Linkage robot = arm(shapes, 2, 1.0, 0.1);
  robot[0].lower = robot[0].upper = 0.0;
  EXPECT_THAT(pairs_to_check(robot, false), IsEmpty());
}

TEST(PairsToCheck, TwoRobotsTooFarFromEachOtherNever) {
  ShapeStore shapes;
  Linkage both = arm(shapes, 1, 1.0, 0.1);
  mount(both, arm(shapes, 1, 1.0, 0.1), {2.5, 0.0}, 0.0);
  EXPECT_THAT(pairs_to_check(both, false), IsEmpty());
}

TEST(PairsToCheck, LinksOnARigidJointAreOne) {
  ShapeStore shapes;
  Linkage robot = arm(shapes, 3, 1.0, 0.1);
  robot[1].lower = robot[1].upper = 0.5;
  EXPECT_THAT(pairs_to_check(robot, false), IsEmpty());
}

/// By the definition: what rigid joints unite is one body, named by its first link. Limits prove nothing
/// here.
TEST(PairsToCheck, LeavesOutOneBodyAndTwoThatAJointJoins) {
  constexpr std::uint64_t kSeed = 20261127;
  Random random(kSeed);
  int asked = 0, left_out = 0;
  for (int trial = 0; trial < 300; ++trial) {
    ShapeStore shapes;
    Linkage forest = random_forest(random, shapes, 8);
    std::vector<std::uint32_t> body(forest.size()), robot(forest.size());
    for (std::uint32_t i = 0; i < forest.size(); ++i) {
      const std::uint32_t parent = forest[i].parent;
      const bool rigid = random() % 3 == 0;
      if (rigid) forest[i].lower = forest[i].upper = 0.5;
      body[i] = rigid && parent != kWorld ? body[parent] : i;
      robot[i] = parent == kWorld ? i : robot[parent];
    }
    const auto hangs_on = [&](std::uint32_t x, std::uint32_t y) {
      const std::uint32_t parent = forest[body[x]].parent;
      return parent != kWorld && body[parent] == body[y];
    };
    std::vector<LinkPair> expected;
    for (std::uint32_t a = 0; a < forest.size(); ++a)
      for (std::uint32_t b = a + 1; b < forest.size(); ++b) {
        const bool joined = body[a] == body[b] || hangs_on(a, b) || hangs_on(b, a);
        if (robot[a] != robot[b] || !joined) expected.push_back({a, b});
        ++(robot[a] == robot[b] && joined ? left_out : asked);
      }
    ASSERT_EQ(pairs_to_check(forest, false, {}, 0), expected) << "seed " << kSeed << ", trial " << trial;
  }
  EXPECT_GT(asked, 2000);
  EXPECT_GT(left_out, 2000);
}

TEST(LimitsKeepApart, BarsThatCannotFoldBack) {
  ShapeStore shapes;
  Linkage robot = arm(shapes, 3, 1.0, 0.1);
  for (Link& link : robot) link.lower = -1.5, link.upper = 1.5;
  EXPECT_TRUE(limits_keep_apart(robot, {0, 2}, 1000));
  for (Link& link : robot) link.lower = -2.5, link.upper = 2.5;
  EXPECT_FALSE(limits_keep_apart(robot, {0, 2}, 1000));
}

TEST(LimitsKeepApart, ASliderThatEndsBeforeTheOther) {
  ShapeStore shapes;
  Linkage robot(2);
  robot[0].shape = robot[1].shape = shapes.add({disc(1.0)});
  robot[0].joint = robot[1].joint = Joint::prismatic;
  robot[1].at = {10, 0};
  robot[0].lower = -4, robot[0].upper = 4, robot[1].lower = -3.9, robot[1].upper = 4;
  EXPECT_TRUE(limits_keep_apart(robot, {0, 1}, 1000)) << "4 + 1 + 1 + 3.9 < 10";
  robot[1].lower = -4.1;
  EXPECT_FALSE(limits_keep_apart(robot, {0, 1}, 1000));
  robot[1].lower = -std::numeric_limits<double>::infinity();
  EXPECT_FALSE(limits_keep_apart(robot, {0, 1}, 1000));
}

/// A telescope that turns and comes out far enough for a post aside.
TEST(LimitsKeepApart, CountsHowFarASliderCarriesWhatTurns) {
  ShapeStore shapes;
  Linkage robot(3);
  robot[0].at = 10.0 * pose({0, 0}, 1.2).rotate({1, 0}), robot[0].lower = robot[0].upper = 0.0;
  robot[1].lower = -1.6, robot[1].upper = 1.6;
  robot[2].parent = 1, robot[2].joint = Joint::prismatic, robot[2].lower = 0.0, robot[2].upper = 8.5;
  robot[0].shape = robot[2].shape = shapes.add({disc(1.0)});
  EXPECT_FALSE(limits_keep_apart(robot, {0, 2}, 1000));
  robot[2].upper = 5.0;
  EXPECT_TRUE(limits_keep_apart(robot, {0, 2}, 1000));
}

TEST(LimitsKeepApart, NeverWhereADistantMountRoundsThemApart) {
  ShapeStore shapes;
  Linkage robot(3);
  for (Link& link : robot) link.lower = link.upper = 0.0;
  robot[1].parent = robot[2].parent = 0;
  robot[1].shape = robot[2].shape = shapes.add({disc(0.5)});
  for (double mount : {0.0, 1e9})
    for (int k = 0; k < 20; ++k) {
      robot[0].at = {mount, 0.0}, robot[1].at = {0.3 + 1e-8 * k, 0.0};
      robot[2].at = robot[1].at + Vec(1.0 - 1e-9, 0.0);
      EXPECT_FALSE(limits_keep_apart(robot, {1, 2}, 100)) << mount << ", " << k;
      robot[2].at = robot[1].at + Vec(1.0 + 1e-9, 0.0);
      EXPECT_TRUE(limits_keep_apart(robot, {1, 2}, 100)) << mount << ", " << k;
    }
}

TEST(LimitsKeepApart, NeverWhereAnAxisIsALittleLongerThanOne) {
  ShapeStore shapes;
  Linkage robot(2);
  robot[0].shape = robot[1].shape = shapes.add({disc(1.0)});
  robot[0].joint = Joint::prismatic, robot[0].axis = {1.0 + 9e-10, 0.0};
  robot[0].lower = -1000.0, robot[0].upper = 1000.0;
  robot[1].at = {1002.0 + 5e-7, 0.0}, robot[1].lower = robot[1].upper = 0.0;
  EXPECT_EQ(fault(robot), "");
  EXPECT_FALSE(limits_keep_apart(robot, {0, 1}, 1000)) << "it slides to 1000 (1 + 9e-10)";
  robot[1].at.x() += 5e-7;
  EXPECT_TRUE(limits_keep_apart(robot, {0, 1}, 1000));
}

TEST(LimitsKeepApart, NeverWhereSamplesMeet) {
  Random random(9);
  int proven = 0, met = 0;
  for (int i = 0; i < 150; ++i) {
    ShapeStore shapes;
    Linkage forest = random_forest(random, shapes, 3);
    for (Link& link : forest) {
      link.lower = uniform(random, -2.0, 1.0), link.upper = link.lower + uniform(random, 0.0, 2.0);
      link.at *= 1.8;
    }
    const bool apart = limits_keep_apart(forest, {0, 2}, 1000);
    bool meet = false;
    std::vector<Pose> poses(3);
    for (int k = 0; k < 300 && !meet; ++k) {
      std::vector<double> values;
      for (const Link& link : forest) values.push_back(uniform(random, link.lower, link.upper));
      place_links(forest, values, poses);
      meet = separation(*forest[0].shape, poses[0], *forest[2].shape, poses[2]).distance <= 0.0;
    }
    EXPECT_FALSE(apart && meet) << "seed 9, forest " << i;
    proven += apart, met += meet;
  }
  EXPECT_GT(proven, 40);
  EXPECT_GT(met, 30);
  EXPECT_GT(proven + met, 110) << "and little is left open";
}

}  // namespace
}  // namespace throng::narrowphase
