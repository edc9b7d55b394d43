// SPDX-License-Identifier: MIT
// Who passes another without touching it goes on as if it weren't there, and who meets it presses where they
// meet, however far a step goes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/sim/trial.h"

namespace throng {
namespace {

constexpr double kDt = 1.0 / 60.0;

const char* const kShapes =
    "[shapes]\nball = { disc = { radius = 0.1 } }\n"
    "box = { polygon = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]] }\n"
    "wedge = { polygon = [[-0.1, -0.05], [0.1, -0.05], [0, 0.1]] }\n"
    "bell = { discs = [[-0.05, 0, 0.1], [0.05, 0, 0.1]] }\n";

std::string header(double restitution) {
  return "gravity = [0, 0]\ntime = { dt = 0.016666666666666667, until = 1 }\n" + material(restitution, 0) +
         kShapes;
}

std::string placed(const std::string& shape, double x, double y, double vx, const std::string& more = "") {
  char text[200];
  std::snprintf(text, sizeof text, "[[bodies]]\nshape = \"%s\"\nat = [%.17g, %.17g]\nvelocity = [%.17g, 0]\n",
                shape.c_str(), x, y, vx);
  return text + more;
}

/// What it passes, with its highest point in the origin.
struct Passed {
  const char* name;
  std::string text;
};

const Passed kStanding[] = {
    {"a wall's end", "[[walls]]\nsegment = [[0, 0], [0, -10]]\n"},
    {"a wall", "[[walls]]\nsegment = [[-0.5, 0], [0.5, 0]]\n"},
    {"a leaning wall", "[[walls]]\nsegment = [[0, 0], [-9, -2]]\n"},
    {"a static box", placed("box", 0, -0.1, 0, "kind = \"static\"\n")},
    {"a static wedge", placed("wedge", 0, -0.1, 0, "kind = \"static\"\n")},
    {"a static disc", placed("ball", 0, -0.1, 0, "kind = \"static\"\n")},
    {"a free box", placed("box", 0, -0.1, 0)},
    {"a free wedge", placed("wedge", 0, -0.1, 0)},
    {"a free bell", placed("bell", 0, -0.1, 0)},
};

/// Who passes: how fast, how far from touching, and how far it is in a step when that begins.
struct Mover {
  std::string shape;
  double speed, clearance, phase;  // m/s, m, 0 to 1
  double spin = 0.0;               // rad/s
};

double lowest(const Mover& mover) {
  if (mover.spin != 0.0) return 0.15;  // m, whichever way round
  return mover.shape == "wedge" ? 0.05 : 0.1;
}

/// How much its velocity has changed once it is by, of what it was.
double change(const Mover& mover, const Passed& passed, double restitution) {
  const double x = -mover.speed * kDt * (1.0 + mover.phase) - 0.3;
  Trial run(header(restitution) +
            placed(mover.shape, x, lowest(mover) + mover.clearance, mover.speed,
                   "spin = " + std::to_string(mover.spin) + "\n") +
            passed.text);
  run.steps(static_cast<int>(std::ceil(-2.0 * x / (mover.speed * kDt))) + 2);
  const double spun = 0.1 * std::abs(run.state.spin[0] - mover.spin);
  return ((run.state.velocity[0] - Vec(mover.speed, 0)).norm() + spun) / mover.speed;
}

/// The worst, wherever a step begins.
double worst_change(Mover mover, const Passed& passed, double restitution) {
  double worst = 0.0;
  for (int k = 0; k < 5; ++k) {
    mover.phase = 0.2 * k;
    worst = std::max(worst, change(mover, passed, restitution));
  }
  return worst;
}

TEST(Approach, WhoPassesWithoutTouchingGoesOnAsBefore) {
  for (const double restitution : {0.0, 0.5})
    for (const std::string mover : {"ball", "box", "wedge", "bell"})
      for (const Passed& passed : kStanding)
        for (const double speed : {1.0, 5.0, 20.0, 200.0})
          for (const double clearance : {0.002, 0.01, 0.05, 0.2}) {
            const double worst = worst_change({mover, speed, clearance, 0.0}, passed, restitution);
            EXPECT_LT(worst, 1e-9) << mover << " past " << passed.name << " at " << speed << " m/s, "
                                   << clearance << " m clear, restitution " << restitution;
          }
}

TEST(Approach, WhoSpinsPastWithoutTouchingGoesOnAsBefore) {
  for (const double restitution : {0.0, 0.5})
    for (const std::string mover : {"box", "wedge", "bell"})
      for (const Passed& passed : kStanding)
        for (const double speed : {1.0, 5.0, 20.0})
          for (const double clearance : {0.002, 0.05})
            for (const double spin : {-20.0, -3.0, 1.0, 10.0, 30.0})
              EXPECT_LT(worst_change({mover, speed, clearance, 0.0, spin}, passed, restitution), 1e-9)
                  << mover << " past " << passed.name << " at " << speed << " m/s, " << clearance
                  << " m clear, " << spin << " rad/s, restitution " << restitution;
}

TEST(Approach, WhatMovesPastOneThatStandsLeavesIt) {
  for (const std::string kind : {"kinematic", "dynamic"})
    for (const std::string mover : {"ball", "box", "bell"})
      for (const double speed : {1.0, 20.0}) {
        const double x = -speed * kDt * 1.3 - 0.3;
        Trial run(header(0) + placed(mover, x, 0.103, speed, "kind = \"" + kind + "\"\n") +
                  placed("wedge", 0, -0.1, 0) + placed("ball", 0.5, -0.1, 0));
        run.steps(static_cast<int>(std::ceil(-4.0 * x / (speed * kDt))) + 2);
        EXPECT_EQ(run.state.velocity[1], Vec(0, 0)) << kind << " " << mover << " at " << speed;
        EXPECT_EQ(run.state.velocity[2], Vec(0, 0)) << kind << " " << mover << " at " << speed;
      }
}

/// The velocity of a disc after it has met a disc half a radius beside its way, or a corner, frictionless.
struct Oblique {
  const char* name;
  std::string text;
  double reach;  // m, from the middle of what it meets to its own when they meet
  double share;  // of the impulse on an obstacle
};

const Oblique kOblique[] = {
    {"a static disc", placed("ball", 0, 0, 0, "kind = \"static\"\n"), 0.2, 1.0},
    {"a kinematic disc", placed("ball", 0, 0, 0, "kind = \"kinematic\"\n"), 0.2, 1.0},
    {"a free disc", placed("ball", 0, 0, 0), 0.2, 0.5},
    {"a wall's end", "[[walls]]\nsegment = [[0, 0], [0, -10]]\n", 0.1, 1.0},
    {"a post's corner",
     "[[walls]]\nsegment = [[0, 0], [0.5, -1]]\n[[walls]]\nsegment = [[0, 0], [-0.01, -1]]\n", 0.1, 1.0},
};

double oblique_error(const Oblique& met, double restitution, double speed, double phase) {
  const double x = -speed * kDt * (1.0 + phase) - 0.3, beside = 0.5 * met.reach;
  Trial run(header(restitution) + placed("ball", x, beside, speed) + met.text);
  run.steps(static_cast<int>(std::ceil(-1.2 * x / (speed * kDt))) + 2);
  const Vec normal(std::sqrt(0.75), -0.5);
  const Vec expected = Vec(speed, 0) - (1.0 + restitution) * met.share * speed * normal.x() * normal;
  return (run.state.velocity[0] - expected).norm() / speed;
}

TEST(Approach, WhoMeetsAnotherObliquelyLeavesItAsTheNormalWhereTheyMeetSays) {
  for (const double restitution : {0.0, 0.5, 0.99})
    for (const Oblique& met : kOblique)
      for (const double speed : {1.0, 5.0, 20.0}) {
        double worst = 0.0;
        for (int k = 0; k < 10; ++k) worst = std::max(worst, oblique_error(met, restitution, speed, 0.1 * k));
        EXPECT_LT(worst, 1e-6) << met.name << " at " << speed << " m/s, restitution " << restitution;
      }
}

/// The straight way goes on through the first tile into the side of the next, which nobody gets to: it turns
/// where it meets the first. Of 20 m/s a corner beside the place of the impact takes 6 % at worst, and turns
/// up 8 as both stop the disc at once; it took all.
TEST(Approach, WhoMeetsAFloorOfTilesHardlyMeetsTheirSides) {
  for (const double restitution : {0.0, 0.5})
    for (const double vy : {1.0, 5.0})
      for (int k = 0; k < 20; ++k) {
        const double high = 0.12 + vy * kDt * (1.0 + 0.05 * k), first = -0.1 + 0.013 * k;
        Trial run(header(restitution) + placed("ball", 0, high, 20.0) +
                  "[[bodies]]\nshape = \"box\"\nkind = \"kinematic\"\nplace = { lattice = { origin = [" +
                  std::to_string(first) + ", -0.1], spacing = [0.2, 0.2], size = [100, 1] } }\n");
        run.state.velocity[0].y() = -vy;
        run.steps(20);
        EXPECT_NEAR(run.state.velocity[0].x(), 20.0, 0.07 * 20.0) << vy << " " << k;
        EXPECT_NEAR(run.state.velocity[0].y(), restitution * vy, 0.09 * 20.0) << vy << " " << k;
      }
}

/// It once got 1.6 m/s sideways.
TEST(Approach, ADiscThatFallsPastATablesEdgeFallsStraight) {
  for (const double clearance : {0.005, 0.001}) {
    Trial run("gravity = [0, -9.81]\ntime = { dt = 0.01, until = 2 }\n" + material(0, 0) + kShapes +
              placed("ball", 0.1 + clearance, 1, 0) + "[[walls]]\nsegment = [[0, 0], [-1, 0]]\n");
    run.steps(60);
    EXPECT_LT(run.state.position[0].y(), -0.5);
    EXPECT_LT(run.state.velocity[0].x(), 1e-9) << clearance;
    EXPECT_NEAR(run.state.velocity[0].y(), -9.81 * 0.6, 1e-9) << clearance;
  }
}

}  // namespace
}  // namespace throng
