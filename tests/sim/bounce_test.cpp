// SPDX-License-Identifier: MIT
// Restitution against closed forms and conservation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/sim/trial.h"

namespace throng {
namespace {

TEST(Bounce, AnElasticDiscBouncesForEverToTheSameHeight) {
  Trial run(std::string("gravity = [0, -10]\ntime = { dt = 0.01, until = 1, substeps = 4 }\ndomain = { box = "
                        "[[-5, 0], [5, 9]] }\n") +
            material(1, 0) + kDisc + ball(0, 1.5, 0, 0));
  const double before = run.energy();
  double highest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    run.steps(1);
    if (i >= 19000) highest = std::max(highest, run.state.position[0].y());
  }
  EXPECT_NEAR(highest, 1.5, 2e-3);
  EXPECT_NEAR(run.energy() / before, 1.0, 0.02);
}

/// Wherever in a substep it lands.
TEST(Bounce, ADiscWithHalfTheRestitutionRisesToAQuarterOfTheHeight) {
  for (double height = 0.5; height < 12.0; height *= 1.13) {
    Trial run(
        std::string("gravity = [0, -10]\ntime = { dt = 0.01, until = 1, substeps = 4 }\ndomain = { box = "
                    "[[-5, 0], [5, 20]] }\n") +
        material(0.5, 0) + kDisc + ball(0, 0.5 + height, 0, 0));
    while (run.state.velocity[0].y() <= 0.0) run.steps(1);
    double highest = 0.0;
    while (run.state.velocity[0].y() > 0.0) {
      run.steps(1);
      highest = std::max(highest, run.state.position[0].y());
    }
    EXPECT_NEAR((highest - 0.5) / height, 0.25, 0.0025) << height;
  }
}

/// Two corners at once, however far from the middle: what is left of one would turn the plate about the
/// other.
TEST(Bounce, APlateThatLandsFlatWithoutRestitutionLies) {
  for (const double speed : {0.5, 5.0, 50.0}) {
    Trial run(
        "[shapes]\nplate = { polygon = [[-2, -0.1], [2, -0.1], [2, 0.1], [-2, 0.1]] }\n"
        "[[walls]]\nsegment = [[-10, 0], [10, 0]]\n[[bodies]]\nshape = \"plate\"\nat = [0, 0.35]\n"
        "velocity = [0, " +
        std::to_string(-speed) + "]\n");
    run.steps(70);
    EXPECT_NEAR(run.state.position[0].y(), 0.1, 1e-9) << speed;
    EXPECT_NEAR(run.state.velocity[0].norm(), 0.0, 1e-9 * speed);
    EXPECT_NEAR(run.state.spin[0], 0.0, 1e-9 * speed);
  }
}

TEST(Bounce, TwoElasticDiscsExchangeVelocitiesHeadOn) {
  Trial run(std::string("time = { dt = 0.01, until = 1 }\n") + material(1, 0) + kDisc + ball(0, 0, 2, 0) +
            ball(3, 0, -1, 0));
  run.steps(100);
  EXPECT_NEAR(run.state.velocity[0].x(), -1.0, 1e-12);
  EXPECT_NEAR(run.state.velocity[1].x(), 2.0, 1e-12);
}

TEST(Bounce, NewtonsCradleSendsTheLastDiscOff) {
  for (const double gap : {0.0, 1e-6}) {
    std::string text = "time = { dt = 0.01, until = 1 }\n" + material(1, 0) + kDisc + ball(-1, 0, 2, 0);
    for (int i = 1; i < 5; ++i) text += "[[bodies]]\nshape = \"ball\"\nat = [" + std::to_string(i) + ", 0]\n";
    Scene scene = scene_from(text);
    for (std::size_t i = 1; i < 5; ++i) scene.bodies.position[i].x() = static_cast<double>(i) * (1 + gap);
    Trial run(scene);
    run.steps(200);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(run.state.velocity[i].x(), 0.0, 1e-9) << i << " gap " << gap;
    EXPECT_NEAR(run.state.velocity[4].x(), 2.0, 1e-9) << "gap " << gap;
  }
}

TEST(Bounce, AGasKeepsItsMomentumAndEnergy) {
  Trial run(gallery_scene("gas"));
  const double before = kinetic_energy(run.scene, run.state);
  const double scale =
      std::sqrt(2 * before * mass(run.scene, 0) * static_cast<double>(run.scene.bodies.size()));
  run.steps(500);
  EXPECT_GT((run.state.position[0] - run.scene.bodies.position[0]).norm(), 0.0);
  EXPECT_LT(momentum(run.scene, run.state).norm() / scale, 1e-12);
  EXPECT_NEAR(kinetic_energy(run.scene, run.state) / before, 1.0, 1e-9);
  EXPECT_LT(overlap(run.scene, run.state).max, 1e-3 * run.scene.bodies.radius[0]);
}

TEST(Bounce, ABounceThatFallsOnTheEndOfASubstepKeepsItsEnergy) {
  Trial run("time = { dt = 0.01, until = 1, substeps = 4 }\n" + material(1, 0) +
            "[shapes]\nball = { disc = { radius = 0.05 } }\n" + ball(0, 0, 40, 0) + ball(0.2, 0, 0, 0));
  run.steps(5);
  EXPECT_NEAR(run.state.velocity[0].x(), 0.0, 1e-9);
  EXPECT_NEAR(run.state.velocity[1].x(), 40.0, 1e-9);
}

TEST(Bounce, ABodyStruckWithinAStepStillMeetsTheWall) {
  // The second disc gets its speed from the first and reaches the wall in the same step, farther than its own
  // motion said.
  Trial run("time = { dt = 0.01, until = 1, substeps = 4 }\n" + material(1, 0) +
            "[shapes]\nball = { disc = { radius = 0.05 } }\n" + ball(0.08, 0, 20, 0) + ball(0.2, 0, 0, 0) +
            "[[walls]]\nsegment = [[0.28, -1], [0.28, 1]]\n");
  run.steps(5);
  EXPECT_LT(run.state.position[1].x(), 0.28);
  EXPECT_NEAR(kinetic_energy(run.scene, run.state), 0.5 * mass(run.scene, 0) * 400, 1e-9);
}

const std::string kBox = "domain = { box = [[0, 0], [4, 10]] }\n";
const char* const kPolygons =
    "[shapes]\nsquare = { polygon = [[0, 0], [1, 0], [1, 1], [0, 1]] }\n"
    "wedge = { polygon = [[0, 0], [1, 0], [0.5, 1]] }\nbell = { discs = [[0, 0, 0.3], [0.5, 0, 0.3]] }\n"
    "hook = { polygon = [[0, 0], [1, 0], [1, 0.4], [0.4, 0.4], [0.4, 1], [0, 1]] }\n";

std::string body(const std::string& shape, double angle) {
  return "[[bodies]]\nshape = \"" + shape + "\"\nat = [1, 5]\nangle = " + std::to_string(angle) + "\n";
}

TEST(Bounce, ABoxThatLandsFlatRisesFlat) {
  Trial run("gravity = [0, -10]\ntime = { dt = 0.01, until = 1 }\n" + kBox + material(1, 0) + kPolygons +
            body("square", 0.0));
  double highest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    run.steps(1);
    if (i >= 1500) highest = std::max(highest, run.state.position[0].y());
    ASSERT_NEAR(run.state.spin[0], 0.0, 1e-9) << i;
  }
  EXPECT_NEAR(highest, 5.0, 0.01 * 5.0);
}

/// On several tiles, or with several parts of its own: one pair of parts after the other set them spinning.
TEST(Bounce, WhatLandsFlatOnSeveralPartsRisesFlat) {
  const std::string floor = "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n";
  const std::string gap =
      "[[walls]]\nsegment = [[-9, 0], [-0.5, 0]]\n[[walls]]\nsegment = [[0.5, 0], [9, 0]]\n";
  std::string tiles;
  for (const char* x : {"-0.9", "0.1", "1.1"})
    tiles += std::string("[[bodies]]\nshape = \"square\"\nat = [") + x + ", -0.5]\nkind = \"static\"\n";
  const std::string shapes =
      "[shapes]\nsquare = { polygon = [[0, 0], [1, 0], [1, 1], [0, 1]] }\n"
      "table = { polygon = [[-1.5, 0], [-1, 0], [-1, 0.8], [1, 0.8], [1, 0], [1.5, 0], [1.5, 1], [-1.5, 1]] "
      "}\n"
      "feet = { discs = [[-0.9, 0, 0.2], [-0.3, 0, 0.2], [0.3, 0, 0.2], [0.9, 0, 0.2]] }\n"
      "bar = { polygon = [[0, 0], [3, 0], [3, 0.2], [0, 0.2]] }\n";
  for (const double restitution : {0.5, 1.0})
    for (const auto& [shape, on] : {std::pair("square", tiles), std::pair("table", floor),
                                    std::pair("feet", floor), std::pair("bar", gap)}) {
      SCOPED_TRACE(std::string(shape) + " " + std::to_string(restitution));
      Trial run("time = { dt = 0.01, until = 1 }\n" + material(restitution, 0.5) + shapes + on +
                "[[bodies]]\nshape = \"" + shape + "\"\nat = [0, 1.2]\nvelocity = [0, -4]\n");
      run.steps(60);
      const std::size_t body = run.scene.bodies.size() - 1;
      EXPECT_NEAR(run.state.velocity[body].y(), 4.0 * restitution, 1e-9);
      EXPECT_NEAR(run.state.velocity[body].x(), 0.0, 1e-9);
      EXPECT_NEAR(run.state.spin[body], 0.0, 1e-9);
    }
}

/// Far from where its step began, and wherever the wall's middle is: it once stopped bouncing for good.
TEST(Bounce, WhoSlidesFastAlongAWallGoesOnBouncing) {
  for (const double speed : {0.0, 5.0, 20.0})
    for (const double x : {1.0, -90.0}) {
      Trial run("gravity = [0, -9.81]\ntime = { dt = 0.016666666666666666, until = 2 }\n" + material(1, 0) +
                "[shapes]\nball = { disc = { radius = 0.05 } }\n"
                "[[walls]]\nsegment = [[-100, 0], [100, 0]]\n" +
                ball(x, 0.05001, speed, -0.06));
      const auto rising = [&] {
        return 0.5 * run.state.velocity[0].y() * run.state.velocity[0].y() +
               9.81 * (run.state.position[0].y() - 0.05);
      };
      const double before = rising();
      run.steps(120);
      EXPECT_NEAR(rising(), before, 1e-9) << "at " << speed << " m/s from x = " << x;
    }
}

/// Of two corners that hit at once but don't bounce together the one that meets first is struck, not the one
/// whose contact stands first in a list.
TEST(Bounce, ARodThatLandsOnItsEndLeavesAsItsMirrorImageDoes) {
  const auto landed = [](double side) {
    const auto text = [](double number) {
      std::ostringstream out;
      out.precision(17);
      out << number;
      return out.str();
    };
    Trial run("gravity = [0, -9.81]\ntime = { dt = 0.016666666666666666, until = 1 }\n" +
              material(0.53179895671611699, 0) +
              "[shapes]\nrod = { polygon = [[-0.35304491554897327, -0.044114938083787886], "
              "[0.35304491554897327, -0.044114938083787886], [0.35304491554897327, 0.044114938083787886], "
              "[-0.35304491554897327, 0.044114938083787886]] }\n"
              "[[walls]]\nsegment = [[-8, 0], [8, 0]]\n[[bodies]]\nshape = \"rod\"\nat = [" +
              text(side * 0.15822648065407297) + ", 0.73950966935289097]\nangle = " +
              text(side * -1.6893866010534322) + "\nvelocity = [" + text(side * 3.4391895824640497) +
              ", -4.805242006185928]\nspin = " + text(side * 2.740114495253879) + "\n");
    run.steps(13);
    return Vec(side * run.state.spin[0], run.state.velocity[0].y());
  };
  EXPECT_NEAR((landed(1.0) - landed(-1.0)).norm(), 0.0, 1e-6);
}

/// Impulses that stop a blow within a substep aren't those that hold on afterwards.
TEST(Bounce, ABlowThroughAThirdThrowsNobodyBack) {
  for (const std::string shape : {"ball", "block"}) {
    Trial run("time = { dt = 0.01, until = 1 }\n" + material(0, 0.5) +
              "[shapes]\nball = { disc = { radius = 0.5 } }\n"
              "block = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
              "[[walls]]\nsegment = [[0, -5], [0, 5]]\n[[bodies]]\nshape = \"" +
              shape + "\"\nat = [0.5, 0]\n[[bodies]]\nshape = \"" + shape +
              "\"\nat = [3, 0]\nvelocity = [-4, 0]\n");
    run.steps(100);
    for (std::size_t body = 0; body < 2; ++body) EXPECT_LT(run.state.velocity[body].norm(), 0.04) << shape;
  }
}

/// One corner after the other, with the effective mass of the step's beginning, once lost two thirds of the
/// energy in 20 s, and shorter substeps lost more.
TEST(Bounce, AnElasticBodyOfAnyShapeKeepsItsEnergy) {
  for (const std::string shape : {"square", "wedge", "bell", "hook"})
    for (const int substeps : {1, 4, 16}) {
      Trial run("gravity = [0, -10]\ntime = { dt = 0.01, until = 1, substeps = " + std::to_string(substeps) +
                " }\n" + kBox + material(1, 0) + kPolygons + body(shape, 0.3));
      const double before = run.energy();
      run.steps(2000);
      EXPECT_NE(run.state.spin[0], 0.0) << shape;
      EXPECT_NEAR(run.energy() / before, 1.0, 0.02) << shape << " in " << substeps << " substeps";
    }
}

TEST(Bounce, WithoutGravityItKeepsItToRounding) {
  for (const std::string shape : {"square", "wedge", "bell", "hook"}) {
    Trial run("time = { dt = 0.01, until = 1 }\n" + kBox + material(1, 0) + kPolygons + body(shape, 0.3) +
              "velocity = [1, -3]\n");
    const double before = run.energy();
    run.steps(2000);
    EXPECT_NE(run.state.spin[0], 0.0) << shape;
    EXPECT_NEAR(run.energy() / before, 1.0, 1e-9) << shape;
  }
}

/// A blow that runs through a row of discs within one step reaches them all, or the run ends by name: it once
/// stopped looking after four discs, and the fifth flew through the rest.
TEST(Bounce, ABlowRunsThroughARowOfDiscsWithinAStep) {
  for (const double speed : {100.0, 200.0}) {
    std::string text = "time = { dt = 0.01, until = 1 }\n" + material(1, 0) +
                       "[shapes]\nball = { disc = { radius = 0.1 } }\n" + ball(0, 0, speed, 0);
    for (int i = 1; i <= 8; ++i) text += ball(0.25 * i, 0, 0, 0);
    Trial run(text + "[[walls]]\nsegment = [[2.6, -1], [2.6, 1]]\n");
    const double before = run.energy();
    for (int i = 0; i < 5; ++i) {
      run.steps(1);
      for (std::size_t row = 0; row < 9; ++row) {
        const double x = run.state.position[row].x();
        ASSERT_LT(x, 2.6) << row;
        ASSERT_TRUE(row == 0 || x > run.state.position[row - 1].x()) << row << " was passed, step " << i;
      }
      ASSERT_LT(overlap(run.scene, run.state).max, 0.02);
    }
    EXPECT_NEAR(run.energy() / before, 1.0, 1e-9);
  }
}

/// What contacts had done before was done again to who had got elsewhere since: the energy of some grew by
/// thirty times.
TEST(Bounce, NobodyGainsEnergyAmongManyPiecesThatBendTowardsHim) {
  std::ostringstream wall;
  for (int i = 0; i < 600; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 600, r = 2.0 + 0.6 * std::cos(5.0 * t);
    wall << (i > 0 ? ", " : "[[walls]]\npolygon = [") << "[" << r * std::cos(t) << ", " << r * std::sin(t)
         << "]";
  }
  for (const double speed : {20.0, 60.0, 200.0})
    for (const int seed : {0, 1, 2, 3, 11}) {  // the last: turned in a substep from piece to piece, at 60 m/s
      std::ostringstream text;
      text << "time = { dt = 0.016666666666666666, until = 1 }\n"
           << material(1, 0) << "[shapes]\nball = { polygon = [[0, 0], [0.2, 0], [0.1, 0.18]] }\n"
           << ball(-0.15, 0.23, speed * std::cos(4.1 + seed), speed * std::sin(4.1 + seed), -3.7)
           << wall.str() << "]\n";
      Trial run(text.str());
      const double before = run.energy();
      for (int i = 0; i < 60; ++i) {
        run.steps(1);
        ASSERT_LT(run.energy(), 1.001 * before) << "at " << speed << " m/s, step " << i + 1;
      }
    }
}

/// It gets farther in a substep than half a box, but not than half the floor.
TEST(Bounce, AStackThatSlidesFastIsHeldAsOneThatSlidesSlowly) {
  const auto heights = [](double speed) {
    std::string text =
        "gravity = [0, -9.81]\nsleep = false\ntime = { dt = 0.016666666666666666, substeps = 4 }\n" +
        material(0.3, 0) +
        "[shapes]\nball = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
        "[[walls]]\nsegment = [[-10, 0], [1000, 0]]\n";
    for (int i = 0; i < 8; ++i) text += ball(0, 0.5 + i, speed, 0);
    Trial run(text);
    run.steps(240);
    std::vector<double> y;
    for (const Vec& position : run.state.position) y.push_back(position.y());
    return y;
  };
  const std::vector<double> slow = heights(20), fast = heights(200);
  for (std::size_t i = 0; i < slow.size(); ++i)
    EXPECT_NEAR(fast[i], slow[i], 1e-5) << i << ": it sank by 1.3 mm, and by 0.2 more where contacts forgot";
}

}  // namespace
}  // namespace throng
