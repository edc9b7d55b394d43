// SPDX-License-Identifier: MIT
// Each model against its equations, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "broadphase/all_lists.h"
#include "sim/crowd/model.h"

namespace throng {
namespace {

const ModelKind& kind(const std::string& name) {
  for (const ModelKind& one : walking_models())
    if (name == one.name) return one;
  throw std::runtime_error("no model " + name);
}

/// Agents of radius 0.25 m who want to walk along x at 1 m/s.
struct Group {
  explicit Group(std::vector<Vec> places, std::vector<BarrierLine> walls = {})
      : position(std::move(places)),
        velocity(position.size(), Vec(0, 0)),
        towards(position.size(), Vec(1, 0)),
        radius(position.size(), 0.25),
        desired_speed(position.size(), 1.0),
        barriers(walls, 1.0) {}

  Vec ask(const std::string& name, std::uint32_t row = 0) {
    std::vector<double> values;
    for (const ModelParameter& p : kind(name).parameters) values.push_back(p.preset);
    const auto model = kind(name).make(values);
    broadphase::AllLists().find(position, model->reach(0.25), nullptr, near);
    return model->velocity({dt, position, velocity, towards, radius, desired_speed, near, barriers}, row);
  }

  double dt = 0.01;
  std::vector<Vec> position, velocity, towards;
  std::vector<double> radius, desired_speed;
  broadphase::NeighbourLists near;
  Barriers barriers;
};

TEST(ConstantVelocity, WalksTheWayAtTheDesiredSpeed) {
  Group group({{0, 0}, {0.1, 0}});
  group.towards[0] = Vec(0.6, 0.8);
  EXPECT_EQ(group.ask("constant_velocity"), Vec(0.6, 0.8));
}

TEST(SocialForce, ApproachesTheDesiredVelocityInTheReactionTime) {
  Group group({{0, 0}});
  group.velocity[0] = Vec(0.5, 0.2);
  const Vec expected(0.5 + 0.01 * (1.0 - 0.5) / 0.5, 0.2 - 0.01 * 0.2 / 0.5);
  EXPECT_NEAR((group.ask("social_force") - expected).norm(), 0.0, 1e-15);
}

TEST(SocialForce, RepelsByTheGapBetweenTwo) {
  Group group({{0, 0}, {0.58, 0}});  // a gap of one range
  group.desired_speed = {0.0, 0.0};
  const double acceleration = 2000.0 * std::exp(-1.0) / 80.0;
  EXPECT_NEAR(group.ask("social_force", 0).x(), -0.01 * acceleration, 1e-14);
  EXPECT_NEAR(group.ask("social_force", 1).x(), 0.01 * acceleration, 1e-14);
}

TEST(SocialForce, LooksNoFartherThanItsRepulsionCounts) {
  Group group({{0, 0}, {0.5 + 15.9 * 0.08, 0}, {0, 0.5 + 16.1 * 0.08}});
  group.desired_speed = {0.0, 0.0, 0.0};
  const Vec v = group.ask("social_force");
  EXPECT_NEAR(v.x(), -0.01 * 2000.0 * std::exp(-15.9) / 80.0, 1e-20);
  EXPECT_EQ(v.y(), 0.0);
}

TEST(SocialForce, PressesApartAndRubsWhereTwoTouch) {
  Group group({{0, 0}, {0, 0.499}});  // 1 mm deep
  group.desired_speed = {0.0, 0.0};
  group.velocity = {Vec(0, 0), Vec(2, 0)};
  const double push = 2000.0 * std::exp(0.001 / 0.08) + 1.2e5 * 0.001, rub = 2.4e5 * 0.001 * 2.0;
  EXPECT_NEAR(group.ask("social_force").y(), -0.01 * push / 80.0, 1e-13);
  EXPECT_NEAR(group.ask("social_force").x(), 0.01 * rub / 80.0, 1e-13);
}

TEST(SocialForce, AWallSlowsDownWhoRubsAlongIt) {
  Group group({{5, 0.24}}, {{{{0, 0}, {10, 0}}, false}});  // 1 cm deep
  group.velocity[0] = Vec(1, 0);                           // as fast as desired: nothing else acts along x
  EXPECT_NEAR(group.ask("social_force").x(), 1.0 - 0.01 * 2.4e5 * 0.01 / 80.0, 1e-13);
  EXPECT_NEAR(group.ask("social_force").y(), 0.01 * (2000.0 * std::exp(0.01 / 0.08) + 1.2e5 * 0.01) / 80.0,
              1e-13);
}

TEST(SocialForce, FrictionNeverTurnsASlipRound) {
  Group group({{5, 0.13}}, {{{{0, 0}, {10, 0}}, false}});  // 12 cm deep
  group.velocity[0] = Vec(1, 0);
  EXPECT_GE(group.ask("social_force").x(), 0.0);
}

TEST(SocialForce, AWallInManyPiecesPushesLikeOne) {
  BarrierLine pieces{{}, false};
  for (int i = 0; i <= 40; ++i) pieces.points.push_back({0.25 * i, 0.0});
  Group one({{5.1, 0.3}}, {{{{0, 0}, {10, 0}}, false}}), many({{5.1, 0.3}}, {pieces});
  EXPECT_NEAR((one.ask("social_force") - many.ask("social_force")).norm(), 0.0, 1e-14);
  Group at_joint({{5.0, 0.3}}, {pieces});
  EXPECT_NEAR((one.ask("social_force") - at_joint.ask("social_force")).norm(), 0.0, 1e-14);
}

TEST(SocialForce, TwoInOnePlacePart) {
  Group group({{1, 1}, {1, 1}});
  group.desired_speed = {0.0, 0.0};
  EXPECT_LT(group.ask("social_force", 0).x(), 0.0);
  EXPECT_EQ(group.ask("social_force", 0).x(), -group.ask("social_force", 1).x());
}

TEST(CollisionFreeSpeed, WalksFreelyWhereNobodyIsAhead) {
  Group group({{0, 0}, {-1, 0}});
  EXPECT_NEAR(group.ask("collision_free_speed").x(), 1.0, 1e-12);
}

TEST(CollisionFreeSpeed, KeepsTheTimeGapToTheOneAhead) {
  Group group({{0, 0}, {1.1, 0.2}});
  const double gap = std::hypot(1.1, 0.2) - 0.5;
  EXPECT_NEAR(group.ask("collision_free_speed").norm(), gap, 1e-12);
}

TEST(CollisionFreeSpeed, StandsWhereItTouchesTheOneAhead) {
  Group group({{0, 0}, {0.5, 0}});
  const Vec v = group.ask("collision_free_speed");
  EXPECT_LE(v.x(), 0.0) << "it may turn away, but never on";
}

TEST(CollisionFreeSpeed, PassesWhoIsBesideIt) {
  Group group({{0, 0}, {1.0, 0.7}});
  EXPECT_NEAR(group.ask("collision_free_speed").norm(), 1.0, 1e-12);
}

TEST(CollisionFreeSpeed, TurnsAwayByTheSumOfItsNeighbours) {
  Group group({{0, 0}, {0, 0.6}, {0.0, -0.8}});
  const double up = 8.0 * std::exp(-0.1 / 0.1), down = 8.0 * std::exp(-0.3 / 0.1);
  const Vec expected = Vec(1.0, down - up).normalized();
  EXPECT_NEAR((group.ask("collision_free_speed").normalized() - expected).norm(), 0.0, 1e-12);
}

TEST(Models, SayWhichStepsTheyBear) {
  const auto longest = [](const char* name) {
    std::vector<double> values;
    for (const ModelParameter& p : kind(name).parameters) values.push_back(p.preset);
    return kind(name).make(values)->longest_step(0.15, 1.2);
  };
  EXPECT_NEAR(longest("collision_free_speed"), 0.0732, 1e-4);  // as pedestriandynamics.org has it
  EXPECT_LT(longest("social_force"), 0.0365);
  EXPECT_TRUE(std::isinf(longest("constant_velocity")));
}

}  // namespace
}  // namespace throng
