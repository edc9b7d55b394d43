// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/linkage.h"

#include <gtest/gtest.h>

#include "random_linkage.h"

namespace throng::narrowphase {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

std::vector<Pose> placed(const Linkage& linkage, const std::vector<double>& values) {
  std::vector<Pose> poses(linkage.size());
  place_links(linkage, values, poses);
  return poses;
}

void expect_at(const Pose& pose, double x, double y, double cos, double sin) {
  EXPECT_NEAR(pose.position.x(), x, 1e-15);
  EXPECT_NEAR(pose.position.y(), y, 1e-15);
  EXPECT_NEAR(pose.cos, cos, 1e-15);
  EXPECT_NEAR(pose.sin, sin, 1e-15);
}

TEST(PlaceLinks, AddsTheAnglesOfAChain) {
  ShapeStore shapes;
  const std::vector<Pose> poses = placed(arm(shapes, 3, 1.0, 0.1), {kQuarter, -kQuarter, kQuarter});
  expect_at(poses[0], 0, 0, 0, 1);
  expect_at(poses[1], 0, 1, 1, 0);
  expect_at(poses[2], 1, 1, 0, 1);
}

TEST(PlaceLinks, PrismaticSlidesAlongTheParentsAxisAndKeepsItsAngle) {
  Linkage robot(2);
  robot[1] = {nullptr, 0, Joint::prismatic, {1, 0}, kQuarter, {0, 1}};
  const std::vector<Pose> poses = placed(robot, {kQuarter, 3.0});
  expect_at(poses[1], -3, 1, -1, 0);
}

TEST(PlaceLinks, BranchesOfATreeMoveApart) {
  Linkage robot(3);
  robot[1].parent = robot[2].parent = 0;
  robot[1].at = {1, 0}, robot[2].at = {0, 1};
  const std::vector<Pose> poses = placed(robot, {kQuarter, 0.0, kQuarter});
  expect_at(poses[1], 0, 1, 0, 1);
  expect_at(poses[2], -1, 0, -1, 0);
}

TEST(PlaceLinks, IsARigidRotationOfAll) {
  Random random(3);
  ShapeStore shapes;
  const Linkage robot = random_forest(random, shapes, 12);
  Linkage turned;
  mount(turned, robot, {2.0, -1.0}, 0.7);
  const std::vector<double> values = random_values(random, 12, 3.0);
  const std::vector<Pose> before = placed(robot, values), after = placed(turned, values);
  const Pose frame = pose({2.0, -1.0}, 0.7);
  for (std::size_t i = 0; i < 12; ++i) {
    const Vec p{0.3, -0.4};
    EXPECT_NEAR((frame * (before[i] * p) - after[i] * p).norm(), 0.0, 1e-13) << "seed 3, link " << i;
  }
}

TEST(Mount, SecondRobotHangsOnItself) {
  Linkage one(2), both;
  one[1].parent = 0;
  EXPECT_EQ(mount(both, one, {0, 0}, 0.0), 0u);
  EXPECT_EQ(mount(both, one, {5, 0}, 0.0), 2u);
  EXPECT_EQ(both[2].parent, kWorld);
  EXPECT_EQ(both[2].at, Vec(5, 0));
  EXPECT_EQ(both[3].parent, 2u);
}

TEST(Fault, NamesTheLinkAndWhatIsWrong) {
  Linkage robot(2);
  robot[1].parent = 0;
  EXPECT_EQ(fault(robot), "");
  const auto broken = [&](auto breaks) {
    Linkage copy = robot;
    breaks(copy[1]);
    return fault(copy);
  };
  EXPECT_EQ(broken([](Link& l) { l.parent = 1; }), "link 1 hangs on a link that does not come before it");
  EXPECT_EQ(broken([](Link& l) { l.at.x() = NAN; }),
            "link 1 stands at a place or an angle that is not finite");
  EXPECT_EQ(broken([](Link& l) { l.axis = {2, 0}; }), "link 1 has an axis that is not of length 1");
  EXPECT_EQ(broken([](Link& l) { l.axis.y() = NAN; }), "link 1 has an axis that is not of length 1");
  EXPECT_EQ(broken([](Link& l) { l.lower = 1, l.upper = 0; }), "link 1 has limits the wrong way round");
  EXPECT_EQ(broken([](Link& l) { l.upper = NAN; }), "link 1 has limits the wrong way round");
}

TEST(BeyondLimits, FindsTheFirstJoint) {
  Linkage robot(3);
  robot[1].lower = -1, robot[1].upper = 1;
  EXPECT_EQ(beyond_limits(robot, std::vector<double>{9, 1, 9}), std::nullopt);
  EXPECT_EQ(beyond_limits(robot, std::vector<double>{9, 1.1, 9}), 1u);
  EXPECT_EQ(beyond_limits(robot, std::vector<double>{9, NAN, 9}), 1u);
}

TEST(Mount, TurnsTheWayOfASlider) {
  Linkage robot(1), all;
  robot[0].joint = Joint::prismatic;
  mount(all, robot, {1, 2}, M_PI / 2);
  std::vector<Pose> poses(1);
  place_links(all, std::vector{3.0}, poses);
  EXPECT_NEAR(poses[0].position.x(), 1.0, 1e-15);
  EXPECT_NEAR(poses[0].position.y(), 5.0, 1e-15);
}

}  // namespace
}  // namespace throng::narrowphase
