// SPDX-License-Identifier: MIT
// What must hold whatever the scene asks of it: long steps, far places, overlaps at the start, walls that
// crush, a million steps.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/less_when_watched.h"
#include "tests/stability/masonry.h"

namespace throng {
namespace {

TEST(Enduring, AStackStandsInStepsUpToATenthOfASecond) {
  for (const double dt : {1.0 / 240, 1.0 / 120, 1.0 / 60, 1.0 / 30, 1.0 / 20, 1.0 / 10}) {
    Masonry site(dt);
    for (int i = 0; i < 5; ++i) site.box({0.0, 0.5 + i}, 1, 1);
    Trial run(site.text());
    run.steps(static_cast<int>(20 / dt));
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(run.state.position[i].x(), 0.0, 0.01) << "dt " << dt;
    EXPECT_LT(overlap(run.scene, run.state).max, 0.0075) << "dt " << dt;
  }
}

TEST(Enduring, DiscsFallAndRestInStepsOfAnyLength) {
  for (const double dt : {1.0 / 240, 1.0 / 60, 1.0 / 20, 1.0 / 10}) {
    Masonry site(dt);
    for (int i = 0; i < 60; ++i) site.ball({0.3 * (i % 7) - 1, 0.5 + 0.9 * (i / 7)}, 0.1 + 0.01 * (i % 4));
    Trial run(site.text());
    const double before = run.energy();
    run.steps(static_cast<int>(20 / dt));
    EXPECT_LT(run.energy(), before) << "dt " << dt;
    EXPECT_LT(fastest(run.state), 1.0) << "dt " << dt;
    // Nobody's centre gets into the floor; in steps that are short enough, hardly anything of anybody.
    for (const Vec& p : run.state.position) EXPECT_GT(p.y(), dt < 0.02 ? 0.095 : 0.0) << "dt " << dt;
  }
}

/// A few things that fall on each other before anything is chaotic.
State fallen(const Vec& floor) {
  Masonry site(0.01, 0.5, floor);
  for (int i = 0; i < 3; ++i) site.box({0.0, 0.6 + 1.2 * i}, 1, 1);
  site.ball({3.0, 1.0}, 0.5, "velocity = [2, 0]\nspin = 1.0\n");
  Trial run(site.text());
  run.steps(100);
  return run.state;
}

TEST(Enduring, AMillionMetresAwayAllIsTheSame) {
  const State here = fallen({0, 0}), there = fallen({1e6, 1e6});
  for (std::size_t i = 0; i < here.position.size(); ++i) {
    EXPECT_NEAR((there.position[i] - Vec(1e6, 1e6) - here.position[i]).norm(), 0.0, 1e-6) << i;
    EXPECT_NEAR(there.angle[i], here.angle[i], 1e-6) << i;
  }
}

TEST(Enduring, WhatStartsHalfInsideOfEachOtherParts) {
  Masonry site(0.01);
  for (int i = 0; i < 6; ++i) site.box({0.1 * i, 0.5 + 0.5 * i}, 1, 1);
  for (int i = 0; i < 6; ++i) site.ball({10.0 + 0.5 * i, 0.5}, 0.5);
  Trial run(site.text());
  for (int i = 0; i < 1200; ++i) {
    run.steps(1);
    ASSERT_LT(fastest(run.state), 10.0) << "step " << i;
  }
  EXPECT_LT(overlap(run.scene, run.state).max, 0.01);
}

TEST(Enduring, AMirroredSceneStaysMirrored) {
  Masonry site(0.01);
  site.box({0, 0.5}, 2, 1);
  for (const double side : {-1.0, 1.0}) {
    site.ball({side * 1.6, 0.5}, 0.5);
    site.ball({side * 0.55, 1.6}, 0.5, "velocity = [" + std::to_string(-0.2 * side) + ", 0]\n");
    site.box({side * 5, 2}, 1, 1, side * 0.3);
  }
  Trial run(site.text());
  run.steps(300);
  const auto& at = run.state.position;
  EXPECT_NEAR(at[0].x(), 0.0, 5e-3);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_NEAR(at[i].x(), -at[i + 3].x(), 5e-3) << i;
    EXPECT_NEAR(at[i].y(), at[i + 3].y(), 5e-3) << i;
  }
}

TEST(Enduring, AMillionStepsOfAGasKeepMomentumAndEnergy) {
  const int steps = static_cast<int>(less_when_watched(1000000));
  Trial run(
      std::string("seed = 3\ntime = { dt = 0.01, until = 1 }\ndomain = { periodic = [[0, 0], [12, 12]] }\n") +
      material(1, 0) + kDisc +
      "[[bodies]]\nshape = \"ball\"\ncount = 30\nplace = { random = { within = [[0, 0], [12, 12]] } }\n"
      "velocity = { maxwell = 1.0 }\n");
  const double energy = run.energy(), scale = std::sqrt(2 * energy * 30 * mass(run.scene, 0));
  run.steps(steps);
  EXPECT_LT(momentum(run.scene, run.state).norm() / scale, 1e-11);
  EXPECT_NEAR(run.energy() / energy, 1.0, 1e-11);
  EXPECT_LT(overlap(run.scene, run.state).max, 1e-9);
}

TEST(Enduring, AWallThatCrushesEndsInOverlapNotInNonsense) {
  Masonry site(0.01);
  for (int i = 0; i < 20; ++i) site.ball({98.0 + 0.3 * (i % 5), 0.2 + 0.35 * (i / 5)}, 0.15);
  site.box({96.0, 5.0}, 1, 10, 0.0, 1.0, "kind = \"kinematic\"\nvelocity = [1.0, 0]\n");
  Trial run(site.text());
  run.steps(417);  // its face gets to 0.67 m from the wall, where the balls are four rows of five
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_TRUE(run.state.position[i].allFinite());
    EXPECT_LT(run.state.velocity[i].norm(), 100.0);
  }
  EXPECT_GT(overlap(run.scene, run.state).max, 0.1);
}

/// Boxes between a press and wall segments turn by a radian and more in a step. What speed the fastest has
/// then is chance: of forty draws the median is 2 m/s, the largest 16 to 66, of these 89.
TEST(Enduring, BoxesThatArePressedAgainstSegmentsStayWithinReason) {
  for (int draw = 0; draw < 8; ++draw) {
    std::string text =
        "sleep = false\ngravity = [0, -9.81]\ntime = { dt = 0.016666666666666666, until = 9 }\n"
        "[materials.default]\nfriction = 0.6\n[shapes]\n"
        "press = { polygon = [[-3.8, -0.5], [3.8, -0.5], [3.8, 0.5], [-3.8, 0.5]] }\n"
        "box = { polygon = [[-0.15, -0.15], [0.15, -0.15], [0.15, 0.15], [-0.15, 0.15]] }\n"
        "[[walls]]\npolyline = [[-4, 40], [-4, 0], [4, 0], [4, 40]]\n"
        "[[bodies]]\nshape = \"press\"\nat = [0, 5]\nkind = \"kinematic\"\nvelocity = [0, -0.5]\n";
    for (int i = 0; i < 20; ++i)
      text += "[[bodies]]\nshape = \"box\"\nat = [" + std::to_string(-2.0 + 0.8 * (i % 5)) + ", " +
              std::to_string(0.5 + 0.8 * (i / 5)) + "]\nangle = " + std::to_string(2.1 * i + draw) + "\n";
    Trial run(text);
    run.steps(528);  // the press has come down to 0.1 m above the floor
    for (std::size_t i = 1; i < 21; ++i) EXPECT_LT(run.state.velocity[i].norm(), 120.0) << draw;
  }
}

}  // namespace
}  // namespace throng
