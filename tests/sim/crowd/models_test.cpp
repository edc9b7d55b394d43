// SPDX-License-Identifier: MIT
// Each model against its equations, by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

#include "sim/crowd/exponential.h"
#include "sim/crowd/model.h"
#include "sim/crowd/orca.h"
#include "sim/random.h"
#include "tests/sim/crowd/polite.cpp"  // as users add one

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

  Vec ask(const std::string& name, std::uint32_t row = 0) { return ask(kind(name), row); }

  Vec ask(const ModelKind& kind, std::uint32_t row = 0) {
    std::vector<double> values;
    for (const ModelParameter& p : kind.parameters)
      values.push_back(set.contains(p.key) ? set.at(p.key) : p.preset);
    const auto model = kind.make(values);
    const Largest largest{*std::max_element(radius.begin(), radius.end()),
                          *std::max_element(desired_speed.begin(), desired_speed.end())};
    cells.sort(position, model->reach(largest));
    const auto by_place = [&](auto value) {
      std::vector<double> all(position.size() + CrowdView::kPadding);
      for (std::size_t place = 0; place < position.size(); ++place) all[place] = value(cells.row()[place]);
      return all;
    };
    const auto column = [&](const std::vector<Vec>& of, int axis) {
      return by_place([&, axis](std::uint32_t i) { return of[i][axis]; });
    };
    const auto x = column(position, 0), y = column(position, 1), vx = column(velocity, 0),
               vy = column(velocity, 1), tx = column(towards, 0), ty = column(towards, 1),
               radii = by_place([&](std::uint32_t i) { return radius[i]; }),
               speeds = by_place([&](std::uint32_t i) { return desired_speed[i]; }),
               ids = by_place([](std::uint32_t i) { return i + 1.0; }),
               clear = by_place([&](std::uint32_t i) { return barriers.clear(position[i]); });
    std::vector<std::uint32_t> places(position.size());
    std::iota(places.begin(), places.end(), 0u);
    std::vector<Vec> answer(position.size());
    model->steer({dt, 1, 0, cells, x, y, vx, vy, tx, ty, radii, speeds, ids, clear, largest, barriers},
                 places, answer);
    const auto at = std::find(cells.row().begin(), cells.row().end(), row) - cells.row().begin();
    return answer[static_cast<std::size_t>(at)];
  }

  double dt = 0.01;
  std::map<std::string, double> set;  // of the model's parameters
  std::vector<Vec> position, velocity, towards;
  std::vector<double> radius, desired_speed;
  CrowdCells cells;
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
  const double ends = 2.0 * 0.01 * 2.4e5 * 0.001 / 80.0;  // of a slip, in a step, by both
  EXPECT_NEAR(group.ask("social_force").x(), 0.01 * rub / 80.0 / (1.0 + ends), 1e-13);
}

TEST(SocialForce, AWallSlowsDownWhoRubsAlongIt) {
  Group group({{5, 0.24}}, {{{{0, 0}, {10, 0}}, false}});  // 1 cm deep
  group.velocity[0] = Vec(1, 0);                           // as fast as desired: nothing else acts along x
  EXPECT_NEAR(group.ask("social_force").x(), 1.0 / (1.0 + 0.01 * 2.4e5 * 0.01 / 80.0), 1e-13);
  EXPECT_NEAR(group.ask("social_force").y(), 0.01 * (2000.0 * std::exp(0.01 / 0.08) + 1.2e5 * 0.01) / 80.0,
              1e-13);
}

TEST(SocialForce, FrictionNeverTurnsASlipRound) {
  Group group({{5, 0.13}}, {{{{0, 0}, {10, 0}}, false}});  // 12 cm deep
  group.velocity[0] = Vec(1, 0);
  EXPECT_GE(group.ask("social_force").x(), 0.0);
}

TEST(SocialForce, FrictionOfManyEndsASlipAndNeverTurnsItRound) {
  const double apart = 0.47;  // m: 3 cm deep
  std::vector<Vec> around{{0, 0}};
  for (int i = 0; i < 6; ++i)
    around.push_back(apart * Vec(std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3)));
  Group group(around);
  group.desired_speed.assign(7, 0.0);
  group.set["reaction_time"] = 1e3;
  group.velocity.assign(7, Vec(0, 0));
  group.velocity[0] = Vec(1, 0);                   // all push alike: nothing but friction acts along x
  const double each = 0.01 * 2.4e5 * 0.03 / 80.0;  // of a slip, in a step; sin^2 of six directions is 3
  EXPECT_NEAR(group.ask("social_force").x(), 1.0 - 3.0 * each / (1.0 + 2.0 * 3.0 * each), 1e-4);
  Group between({{5, 0.2}}, {{{{0, 0}, {10, 0}}, false}, {{{0, 0.4}, {10, 0.4}}, false}});  // two walls, 5 cm
  between.velocity[0] = Vec(1, 0);
  EXPECT_NEAR(between.ask("social_force").x(), 1.0 / (1.0 + 2.0 * 0.01 * 2.4e5 * 0.05 / 80.0), 1e-12);
}

TEST(SocialForce, WhoIsDrivenAlongAWallSlidesAsFastAsFrictionAllowsWhateverTheStep) {
  for (const double dt : {0.02, 0.01, 0.001}) {
    Group group({{5, 0.2}}, {{{{0, 0}, {10, 0}}, false}, {{{0, 0.4}, {10, 0.4}}, false}});
    group.dt = dt;
    group.velocity[0] = Vec(0, 0);
    for (double t = 0.0; t < 1.0; t += dt) group.velocity[0] = group.ask("social_force");
    const double drive = 80.0 / 0.5, rub = 2.0 * 2.4e5 * 0.05;
    EXPECT_NEAR(group.velocity[0].x(), drive / (drive + rub), 1e-6) << dt;
  }
}

TEST(SocialForce, AWallInManyPiecesPushesLikeOne) {
  BarrierLine pieces{{}, false};
  for (int i = 0; i <= 40; ++i) pieces.points.push_back({0.25 * i, 0.0});
  Group one({{5.1, 0.3}}, {{{{0, 0}, {10, 0}}, false}}), many({{5.1, 0.3}}, {pieces});
  EXPECT_NEAR((one.ask("social_force") - many.ask("social_force")).norm(), 0.0, 1e-14);
  Group at_joint({{5.0, 0.3}}, {pieces});
  EXPECT_NEAR((one.ask("social_force") - at_joint.ask("social_force")).norm(), 0.0, 1e-14);
}

TEST(SocialForce, AWallInPiecesOfTheirOwnPushesLikeOne) {
  std::vector<BarrierLine> pieces;
  for (int i = 0; i < 40; ++i) {
    pieces.push_back({{{0.25 * i, 0.0}, {0.25 * (i + 1), 0.0}}, false});
    if (i % 3 == 0) std::swap(pieces.back().points[0], pieces.back().points[1]);
    if (i % 5 == 0) pieces.push_back(pieces.back());
  }
  for (int i = 0; i < 30; ++i) {
    const Vec at(4.0 + 0.05 * i, 0.3);
    Group one({at}, {{{{0, 0}, {10, 0}}, false}}), many({at}, pieces);
    EXPECT_NEAR((one.ask("social_force") - many.ask("social_force")).norm(), 0.0, 1e-14) << at.x();
  }
}

TEST(SocialForce, ACornerOfSeveralWallsPushesOnce) {
  Group corner({{0.2, 0.2}}, {{{{-5, 0}, {0, 0}, {0, -5}}, false}});
  Group walls({{0.2, 0.2}}, {{{{-5, 0}, {0, 0}}, false}, {{{0, -5}, {0, 0}}, false}});
  Group three({{0.2, 0.2}},
              {{{{-5, 0}, {0, 0}}, false}, {{{0, -5}, {0, 0}}, false}, {{{-3, -3}, {0, 0}}, false}});
  EXPECT_EQ(corner.ask("social_force"), walls.ask("social_force"));
  EXPECT_EQ(corner.ask("social_force"), three.ask("social_force"));
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

/// Tordeux, Chraibi and Seyfried (2016), as the paper writes it, but for turns of less than a millionth.
Vec by_the_paper(const Group& all, std::size_t own, double time_gap, double strength, double range) {
  Vec way = all.towards[own];
  std::vector<Vec> to;         // unit vectors
  std::vector<double> far, l;  // m
  for (std::size_t other = 0; other < all.position.size(); ++other) {
    const Vec d = all.position[other] - all.position[own];
    if (other == own || d.norm() > 3.0) continue;
    to.push_back(d / d.norm()), far.push_back(d.norm()), l.push_back(all.radius[own] + all.radius[other]);
    if (const double power = (l.back() - far.back()) / range; power >= -kNegligibleRanges)
      way -= strength * std::exp(power) * to.back();
  }
  way /= way.norm();
  double speed = all.desired_speed[own];
  for (std::size_t k = 0; k < to.size(); ++k)
    if (way.dot(to[k]) >= 0.0 && std::abs(cross(way, to[k])) <= l[k] / far[k])
      speed = std::min(speed, std::max(0.0, (far[k] - l[k]) / time_gap));
  return speed * way;
}

TEST(CollisionFreeSpeed, WalksByThePaperInCrowdsOfAnyDensity) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int slowed = 0, stopped = 0, asked = 0;
  for (const double density : {0.3, 1.0, 3.0, 6.0}) {
    const double side = std::sqrt(60.0 / density);
    std::vector<Vec> places;
    for (int i = 0; i < 60; ++i) places.push_back({uniform(0.0, side), uniform(0.0, side)});
    Group all(places);
    all.set = {{"time_gap", 0.5}, {"neighbour_range", 0.14}};
    for (std::size_t i = 0; i < 60; ++i) {
      const double angle = uniform(-3.1, 3.1);
      all.towards[i] = {std::cos(angle), std::sin(angle)};
      all.radius[i] = uniform(0.18, 0.22), all.desired_speed[i] = uniform(0.5, 1.8);
    }
    for (std::uint32_t i = 0; i < 60; ++i, ++asked) {
      const Vec answer = all.ask("collision_free_speed", i), right = by_the_paper(all, i, 0.5, 8.0, 0.14);
      EXPECT_LT((answer - right).norm(), 1e-9) << i << " at " << density << " /m2";
      stopped += right.norm() == 0.0;
      slowed += right.norm() > 0.0 && right.norm() < all.desired_speed[i] - 1e-9;
    }
  }
  EXPECT_GT(slowed, asked / 10);
  EXPECT_GT(stopped, asked / 10);
}

TEST(CollisionFreeSpeed, LeavesOutWhoIsTooFarToSlowItDown) {
  Group group({{0, 0}, {1.52, 0}});
  group.set = {{"neighbour_strength", 0.0}, {"time_gap", 1.0}};
  EXPECT_EQ(group.ask("collision_free_speed"), Vec(1, 0)) << "a gap of 1.02 m at 1 m/s and 1 s";
  group.position[1] = Vec(1.45, 0);
  EXPECT_NEAR(group.ask("collision_free_speed").x(), 0.95, 1e-12);
  group.desired_speed[0] = 2.0;
  group.position[1] = Vec(2.4, 0);
  EXPECT_NEAR(group.ask("collision_free_speed").x(), 1.9, 1e-12) << "who is faster looks farther";
}

TEST(CollisionFreeSpeed, NoiseTurnsItTheSameWayEachTime) {
  Group group({{0, 0}});
  group.set = {{"noise", 0.1}};
  const Vec v = group.ask("collision_free_speed");
  EXPECT_NEAR(v.norm(), 1.0, 1e-15);
  EXPECT_NE(v, Vec(1, 0));
  EXPECT_LE(std::abs(v.y()), 0.1 / 0.9);
  EXPECT_EQ(group.ask("collision_free_speed"), v) << "by seed, step and id";
}

TEST(Models, PresetsHaveAValueInRangeForEachParameter) {
  for (const ModelKind& one : walking_models())
    for (const ModelPreset& preset : one.presets) {
      ASSERT_EQ(preset.values.size(), one.parameters.size()) << one.name << " " << preset.name;
      for (std::size_t i = 0; i < one.parameters.size(); ++i) {
        EXPECT_GE(preset.values[i], one.parameters[i].low) << one.parameters[i].key;
        EXPECT_LE(preset.values[i], one.parameters[i].high) << one.parameters[i].key;
      }
    }
}

/// Both must give way by half of what brings them past each other: their half planes by the paper, by hand.
TEST(Orca, TwoWhoMeetShareTheWayRound) {
  Group group({{0, 0}, {4, 0.3}});
  group.velocity = {{1, 0}, {-1, 0}}, group.towards = {{1, 0}, {-1, 0}};
  const Vec a = group.ask("orca", 0), b = group.ask("orca", 1);
  // The left leg of the disc of 0.5 m about (4, 0.3) is at 4.289 + 7.140 degrees, the right one at 2.851
  // below.
  const double leg = std::atan2(0.3, 4.0) - std::asin(0.5 / std::hypot(4.0, 0.3));
  const Vec normal(std::sin(leg), -std::cos(leg)), out = (Vec(2, 0).dot(normal)) * normal;
  const Vec expected = Vec(1, 0) - 0.5 * out;
  EXPECT_NEAR((a - expected).norm(), 0.0, 3e-3) << "but for the doubt";
  EXPECT_NEAR((a + b).norm(), 0.0, 3e-3);
}

TEST(Orca, WalksAsWantedWhereNobodyIsInTheWay) {
  Group group({{0, 0}, {-2, 0}, {0, 3}});
  group.velocity = {{1, 0}, {1, 0}, {1, 0}};
  const Vec v = group.ask("orca");
  EXPECT_NEAR((v - Vec(1, 0)).norm(), 0.0, 1.5e-3);
  EXPECT_NE(v, Vec(1, 0)) << "it is in doubt";
}

// Several agents' numbers are drawn together: each is to get his own, which Random draws of his id.
TEST(Orca, IsInDoubtByTheNumbersOfEachOnesId) {
  std::vector<Vec> places;
  for (int i = 0; i < 37; ++i) places.emplace_back(100.0 * i, 0.0);
  Group group(places);
  double least = 1.0, most = -1.0;
  for (std::uint32_t row = 0; row < places.size(); ++row) {
    Random random(1, 0, row + 1, Purpose::doubt);
    const double x = random.uniform(-kOrcaDoubt, kOrcaDoubt), y = random.uniform(-kOrcaDoubt, kOrcaDoubt);
    EXPECT_EQ(group.ask("orca", row), group.towards[row] + Vec(x, y)) << row;
    least = std::min({least, x, y}), most = std::max({most, x, y});
  }
  EXPECT_TRUE(least < -0.9 * kOrcaDoubt && most > 0.9 * kOrcaDoubt) << least << ' ' << most;
}

TEST(Orca, StopsBeforeAWallInTime) {
  Group group({{0, 0}}, {{{{0.6, -5}, {0.6, 5}}, false}});
  group.velocity[0] = Vec(1, 0);
  EXPECT_NEAR(group.ask("orca").x(), (0.6 - 0.25) / 0.5, 1e-12);
  group.position[0].x() = 0.4;
  EXPECT_LE(group.ask("orca").x(), 1e-15) << "it touches the wall";
}

TEST(Orca, LooksAtTheNearestTenAlone) {
  std::vector<Vec> places{{0, 0}};
  for (int i = 0; i < 10; ++i) places.push_back({-0.6 - 0.1 * i, 0.0});
  Group few(places);
  places.push_back({1.7, 0.0});
  Group many(places), less(places);
  EXPECT_EQ(few.ask("orca"), many.ask("orca")) << "ten behind are nearer than the one ahead";
  less.position[5] = {-40, 0};
  EXPECT_NE(few.ask("orca"), less.ask("orca"));
}

TEST(Orca, FindsTheNearestTenOfACrowdInAnyOrder) {
  std::vector<Vec> places{{0, 0}};
  for (int i = 0; i < 80; ++i) {
    const double angle = 2.4 * i;
    places.push_back((0.6 + 0.05 * i) * Vec(std::cos(angle), std::sin(angle)));
  }
  Group few({places.begin(), places.begin() + 11}), many(places);
  std::reverse(places.begin() + 1, places.end());
  Group reversed(places);
  for (Group* group : {&few, &many, &reversed}) group->velocity[0] = Vec(1, 0);
  EXPECT_EQ(few.ask("orca"), many.ask("orca"));
  EXPECT_EQ(few.ask("orca"), reversed.ask("orca"));
}

TEST(Orca, TwoInOnePlacePart) {
  Group group({{1, 1}, {1, 1}});
  group.desired_speed = {0.0, 0.0};
  EXPECT_LT(group.ask("orca", 0).x(), -0.5);
  EXPECT_GT(group.ask("orca", 1).x(), 0.5);
}

// Test 2 of Juelich's for models of this kind: who stands behind a wall isn't there.
TEST(Models, LookAtNobodyBehindAWall) {
  const std::vector<BarrierLine> walls{{{{-9, 0.7}, {0.3, 0.7}}, false},
                                       {{{1.2, -2}, {1.2, 2}, {3, 2}}, false},
                                       {{{-0.4, -0.7}, {-0.7, -0.7}}, false}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> far(-2.4, 2.4);
  int hidden = 0, seen = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int others = 1 + trial % 12;
    std::vector<Vec> all{{0, 0}}, visible{{0, 0}};
    const Barriers barriers(walls, 1.0);
    for (int i = 0; i < others; ++i) {
      const Vec p(far(random), far(random));
      all.push_back(p);
      if (!barriers.block(all[0], p)) visible.push_back(p);
    }
    seen += static_cast<int>(visible.size()) - 1, hidden += static_cast<int>(all.size() - visible.size());
    Group far_from_walls(all, walls), on_open_floor(visible);
    const char* const turned_by_none = "collision_free_speed";  // of these walls
    ASSERT_NEAR((far_from_walls.ask(turned_by_none) - on_open_floor.ask(turned_by_none)).norm(), 0.0, 1e-12);
    for (const char* model : {"social_force", "collision_free_speed", "orca"}) {
      Group group(all, walls), alone(visible, walls);
      ASSERT_NEAR((group.ask(model) - alone.ask(model)).norm(), 0.0, 1e-12) << model << " trial " << trial;
    }
  }
  EXPECT_GT(hidden, 400);
  EXPECT_GT(seen, 400);
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

/// README.md shows this model as all that it takes to add one.
TEST(OwnModel, WalksAsReadmeShowsIt) {
  std::ifstream readme(THRONG_SOURCE_DIR "/README.md"),
      model(THRONG_SOURCE_DIR "/tests/sim/crowd/polite.cpp");
  const std::string shown(std::istreambuf_iterator<char>(readme), {}),
      built(std::istreambuf_iterator<char>(model), {});
  EXPECT_GT(built.size(), 500u);
  EXPECT_NE(shown.find("```cpp\n" + built + "```\n"), std::string::npos);

  Group group({{0, 0}, {0.9, 0}, {5, 0}});
  EXPECT_EQ(group.ask(polite(), 0), Vec(0, 0)) << "0.4 m behind the next one";
  EXPECT_EQ(group.ask(polite(), 1), Vec(1, 0)) << "nobody is near ahead";
  group.set["room"] = 0.3;
  EXPECT_EQ(group.ask(polite(), 0), Vec(1, 0));
}

}  // namespace
}  // namespace throng
