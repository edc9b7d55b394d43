// SPDX-License-Identifier: MIT
// The loop against laws: what a step must do to a body is known in closed form.
#include "sim/step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/observe.h"
#include "sim/simulation_error.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

TEST(Step, WhoFallsFreelyKeepsToAParabola) {
  for (const double dt : {0.1, 0.01}) {
    Trial run("gravity = [0, -10]\ntime = { dt = " + std::to_string(dt) + ", until = 1, substeps = 4 }\n" +
              kDisc + ball(0, 0, 3, 2) + ball(5, -9, 0, 0) + "[[walls]]\nsegment = [[4, -9.5], [6, -9.5]]\n");
    run.steps(static_cast<int>(std::lround(1.0 / dt)));
    EXPECT_NEAR(run.state.position[0].y(), 2.0 - 0.5 * 10, 1e-12) << dt;
    EXPECT_NEAR(run.state.position[0].x(), 3.0, 1e-12) << dt;
    EXPECT_NEAR(run.state.velocity[0].y(), 2.0 - 10.0, 1e-12) << dt;
    EXPECT_NEAR(run.state.position[1].y(), -9.0, 1e-3) << "who lies stays";
  }
}

TEST(Step, TimeIsTheNumberOfStepsTimesTheirLength) {
  Trial run(std::string("time = { dt = 0.1, until = 1 }\n") + kDisc + ball(0, 0, 0, 0));
  run.steps(7);
  EXPECT_EQ(run.state.step, 7);
}

/// Of few bodies one step of many is measured, and stands for them.
TEST(Step, ItsStagesTakeTime) {
  for (const int steps : {1, 1000}) {
    Trial run(std::string("time = { dt = 0.01, until = 100 }\n") + kDisc + ball(0, 0, 0, 0) +
              ball(3, 0, 0, 0));
    run.steps(steps);
    EXPECT_EQ(run.work.times.sampling.steps(), steps);
    EXPECT_GT(run.work.times.find_pairs, 0.0) << steps;
    EXPECT_GT(run.work.times.solve, 0.0) << steps;
  }
}

TEST(Step, AnObliqueImpactObeysCoulomb) {
  // Against a wall, with I = m r² / 2: either it slides all the while, or it grips (notes in any mechanics
  // text).
  for (const double friction : {0.05, 0.8}) {
    Trial run(std::string("time = { dt = 0.001, until = 1 }\ndomain = { box = [[-50, 0], [50, 9]] }\n") +
              material(0.6, friction) + kDisc + ball(0, 1, 1, -4, 3));
    run.steps(400);
    const double r = 0.5, vn = 4, slip = 1 + 3 * r;  // surface against wall
    const double grip = slip / 3, slide = friction * (1 + 0.6) * vn;
    const double change = std::min(grip, slide);
    EXPECT_NEAR(run.state.velocity[0].y(), 0.6 * vn, 1e-9) << "friction " << friction;
    EXPECT_NEAR(run.state.velocity[0].x(), 1 - change, 1e-9) << "friction " << friction;
    EXPECT_NEAR(run.state.spin[0], 3 - 2 * change / r, 1e-9) << "friction " << friction;
  }
}

TEST(Step, ASlidingDiscEndsUpRolling) {
  Trial run(
      std::string(
          "gravity = [0, -10]\ntime = { dt = 0.01, until = 1 }\ndomain = { box = [[-50, 0], [50, 9]] }\n") +
      material(0, 0.3) + kDisc + ball(0, 0.5, 3, 0));
  run.steps(100);  // rolls after v0 / (3 mu g) = 0.33 s
  EXPECT_NEAR(run.state.velocity[0].x(), 2.0, 0.01);
  EXPECT_NEAR(run.state.spin[0], -4.0, 0.02);
  EXPECT_NEAR(run.state.position[0].y(), 0.5, 1e-3);
}

TEST(Step, ABlockOnASlopeSlidesOnlyWhereItIsSteeperThanFriction) {
  const auto slope = [](double gx) {
    return "gravity = [" + std::to_string(gx) +
           ", -10]\ntime = { dt = 0.01, until = 1 }\ndomain = { box = [[-50, 0], [50, 9]] }\n" +
           material(0, 0.5) +
           "[shapes]\nblock = { polygon = [[-1, -0.5], [1, -0.5], [1, 0.5], [-1, 0.5]] }\n" +
           "[[bodies]]\nshape = \"block\"\nat = [0, 0.5]\n";
  };
  Trial rests(slope(4.5)), slides(slope(6.0));
  rests.steps(200), slides.steps(200);
  EXPECT_NEAR(rests.state.position[0].x(), 0.0, 1e-3);
  EXPECT_NEAR(slides.state.velocity[0].x(), (6.0 - 0.5 * 10) * 2.0, 0.02);
  EXPECT_NEAR(slides.state.angle[0], 0.0, 1e-4);  // its front edge carries more, and contacts are soft
}

TEST(Step, AStackOfBoxesStands) {
  std::string text =
      "sleep = false\ngravity = [0, -10]\ntime = { dt = 0.01, until = 1 }\ndomain = { box = [[-9, 0], [9, "
      "30]] }\n" +
      material(0, 0.5) + "[shapes]\nbox = { polygon = [[0, 0], [1, 0], [1, 1], [0, 1]] }\n" +
      "[[bodies]]\nshape = \"box\"\nplace = { lattice = { origin = [0, 0.5], spacing = [1, 1], size = [1, "
      "10] } }\n";
  Trial run(text);
  run.steps(2000);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(run.state.position[i].x(), 0.0, 1e-3) << "box " << i;
    EXPECT_NEAR(run.state.position[i].y(), 0.5 + static_cast<double>(i), 0.02) << "box " << i;
    EXPECT_LT(run.state.velocity[i].norm(), 1e-3) << "box " << i;
  }
}

TEST(Step, OverlappingDiscsPartWithoutExploding) {
  Trial run(std::string("time = { dt = 0.01, until = 1 }\n") + material(0, 0.5) + kDisc + ball(0, 0, 0, 0) +
            ball(0.5, 0, 0, 0));
  double fastest = 0.0;
  for (int i = 0; i < 200; ++i) {
    run.steps(1);
    fastest = std::max(fastest, run.state.velocity[0].norm());
  }
  EXPECT_LT(overlap(run.scene, run.state).max, 1e-3);
  EXPECT_LT(fastest, 1.0);
}

TEST(Step, CoincidentDiscsPartToo) {
  Trial run(std::string("time = { dt = 0.01, until = 1 }\n") + material(0, 0.5) + kDisc + ball(0, 0, 0, 0) +
            ball(0, 0, 0, 0));
  run.steps(200);
  EXPECT_LT(overlap(run.scene, run.state).max, 1e-3);
}

TEST(Step, AKinematicBodyPushesAndIsNotPushed) {
  const std::string push =
      "[[bodies]]\nshape = \"ball\"\nat = [-2, 0]\nvelocity = [1, 0]\nkind = \"kinematic\"\n";
  Trial run(std::string("time = { dt = 0.01, until = 1 }\n") + material(0, 0) + kDisc + push +
            ball(0, 0, 0, 0));
  run.steps(300);
  EXPECT_NEAR(run.state.position[0].x(), 1.0, 1e-12);
  EXPECT_NEAR(run.state.position[1].x(), 2.0, 1e-2);
}

TEST(Step, APeriodicDomainLetsDiscsCollideAcrossItsSeam) {
  Trial run(std::string("time = { dt = 0.01, until = 1 }\ndomain = { periodic = [[0, 0], [10, 10]] }\n") +
            material(1, 0) + kDisc + ball(9, 5, 1, 0) + ball(1, 5, -1, 0));
  run.steps(200);
  EXPECT_NEAR(run.state.velocity[0].x(), -1.0, 1e-12);
  EXPECT_NEAR(run.state.velocity[1].x(), 1.0, 1e-12);
}

/// A rod of discs, as long as a good part of the period, and what it meets, moved round the domain by (dx,
/// dy).
Scene across_the_seam(double dx, double dy) {
  Scene scene = scene_from(
      "time = { dt = 0.01, until = 1 }\ndomain = { periodic = [[0, 0], [20, 20]] }\n" + material(0.5, 0.3) +
      "[shapes]\nball = { disc = { radius = 0.3 } }\n"
      "rod = { discs = [[0, 0, 0.2], [0.3, 0, 0.2], [0.6, 0, 0.2], [0.9, 0, 0.2], [1.2, 0, 0.2], [1.5, 0, "
      "0.2], [1.8, 0, "
      "0.2]] }\nell = { polygon = [[0, 0], [2, 0], [2, 0.5], [0.5, 0.5], [0.5, 2], [0, 2]] }\n"
      "[[bodies]]\nshape = \"rod\"\nat = [10, 10]\nspin = 1\n" +
      ball(12, 10, -2, 0) +
      "[[bodies]]\nshape = \"ell\"\nat = [10, 12]\nvelocity = [0, -1.013]\nangle = 0.3\n"
      "[[bodies]]\nshape = \"ell\"\nat = [8, 8]\nvelocity = [0.5, 0.531]\nangle = 0.2\n"
      "[[bodies]]\nshape = \"ball\"\nat = [8, 11]\nkind = \"static\"\n[[walls]]\nsegment = [[9, 8.5], [12, "
      "8.5]]\n");
  const Vec by(dx, dy);
  for (Vec& p : scene.bodies.position)
    p = (p + by).unaryExpr([](double x) { return x - 20.0 * std::floor(x / 20.0); });
  for (Vec& p : scene.walls[0].points) p = p + by;
  if (scene.walls[0].points[0].x() >= 20)
    for (Vec& p : scene.walls[0].points) p.x() -= 20;
  return scene;
}

TEST(Step, APeriodicDomainHasNoSeamForAnyShape) {
  Trial reference(across_the_seam(0, 0));
  reference.steps(300);
  const double energy = kinetic_energy(reference.scene, reference.state);
  ASSERT_NE(energy, kinetic_energy(reference.scene, initial_state(reference.scene))) << "nothing met";
  for (const Vec& by : {Vec(10.0, 0.0), Vec(0.0, 10.0), Vec(9.5, 8.0), Vec(10.5, 9.0), Vec(11.5, 11.5)}) {
    Trial moved(across_the_seam(by.x(), by.y()));
    moved.steps(300);
    EXPECT_NEAR(kinetic_energy(moved.scene, moved.state), energy, 1e-6 * energy) << by.transpose();
    for (std::size_t i = 0; i < moved.state.velocity.size(); ++i)
      EXPECT_LT((moved.state.velocity[i] - reference.state.velocity[i]).norm(), 1e-6)
          << "body " << i << " " << by.transpose();
  }
}

TEST(Step, ABodyThatReachesTooFarRoundThePeriodEndsTheRunByName) {
  Trial run(std::string("time = { dt = 0.1, until = 1 }\ndomain = { periodic = [[0, 0], [10, 10]] }\n") +
            kDisc + ball(2, 2, 0, 0) + ball(5, 5, 0, 0));
  run.state.velocity[1] = Vec(90, 0);
  try {
    run.steps(1);
    ADD_FAILURE() << "went on";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("body 2 may reach 9.55 m within its 0.1 s"));
  }
}

TEST(Step, ACompositeTurnsAboutItsCentreOfMass) {
  // A free dumbbell, struck off its centre: momentum and angular momentum stay.
  Trial run("time = { dt = 0.005, until = 1 }\n" + material(1, 0) +
            "[shapes]\nball = { disc = { radius = 0.5 } }\nbell = { discs = [[-1, 0, 0.5], [1, 0, 0.5]] }\n"
            "[[bodies]]\nshape = \"bell\"\nat = [0, 0]\n" +
            ball(1.1, 3, 0, -2));
  const auto angular = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec &x = run.state.position[i], &v = run.state.velocity[i];
      sum += mass(run.scene, i) * cross(x, v) + inertia(run.scene, i) * run.state.spin[i];
    }
    return sum;
  };
  const double before = angular(), energy = run.energy();
  run.steps(400);
  EXPECT_NE(run.state.spin[0], 0.0) << "nothing met";
  EXPECT_NEAR(momentum(run.scene, run.state).y(), -2 * mass(run.scene, 1), 1e-12);
  EXPECT_NEAR(angular(), before, 0.02 * std::abs(before));
  EXPECT_NEAR(run.energy(), energy, 1e-9 * energy);
}

TEST(Step, ADiscStaysBetweenTwoWallSegments) {
  Trial run(std::string("gravity = [0, -10]\ntime = { dt = 0.01, until = 1 }\n") + material(0, 0.3) + kDisc +
            ball(0, 3, 0.3, 0) + "[[walls]]\npolyline = [[-4, 4], [0, 0], [4, 4]]\n");
  run.steps(1000);
  // The disc rests where both slopes of 45 degrees touch it: its centre is sqrt(2) radii above the corner.
  EXPECT_NEAR(run.state.position[0].x(), 0.0, 1e-3);
  EXPECT_NEAR(run.state.position[0].y(), 0.5 * std::sqrt(2.0), 2e-3);
}

TEST(Step, ABodyThatLeavesTheRepresentablePlaneEndsTheRunByName) {
  Trial run(std::string("gravity = [0, -1e9]\ntime = { dt = 1, until = 1000 }\n") + kDisc + ball(0, 0, 0, 0) +
            ball(3, 0, 0, 0));
  try {
    run.steps(1000);
    FAIL() << "the run went on";
  } catch (const SimulationError& error) {
    EXPECT_THAT(std::string(error.what()), ::testing::HasSubstr("body 1"));
    EXPECT_THAT(std::string(error.what()), ::testing::HasSubstr("step "));
  }
}

TEST(Step, ABodyThatGetsInfinitelyFarWithinAStepEndsTheRunByName) {
  Trial run(std::string("time = { dt = 0.01, until = 1 }\n") + kDisc + ball(0, 0, 0, 0) + ball(3, 0, 0, 0));
  run.state.velocity[1] = {1e200, 0.0};  // whose square no double holds
  try {
    run.steps(1);
    FAIL() << "the run went on";
  } catch (const SimulationError& error) {
    EXPECT_THAT(std::string(error.what()), ::testing::HasSubstr("step 1: body 2 gets infinitely far"));
  }
}

/// On a blade that turns about the origin by w, a disc goes outwards as r = r0 cosh(w t) + c sinh(w t), and
/// across as fast as the blade, w r, but for what a step's normal is late.
TEST(Step, ATurningBladePushesADiscAsFastAsItTurns) {
  Trial run("time = { dt = 0.01, until = 9 }\n" + material(0, 0) +
            "[shapes]\nball = { disc = { radius = 0.1 } }\n"
            "blade = { polygon = [[-4, -0.01], [4, -0.01], [4, 0.01], [-4, 0.01]] }\n"
            "[[bodies]]\nshape = \"blade\"\nkind = \"kinematic\"\nat = [0, 0]\nspin = 1\n" +
            ball(1, 0.11, 0, 1));
  run.steps(100);
  const Vec along(std::cos(run.state.angle[0]), std::sin(run.state.angle[0]));
  const Vec &place = run.state.position[1], &velocity = run.state.velocity[1];
  const double r = place.dot(along), across = tangent(along).dot(velocity);
  EXPECT_NEAR(across, r, 0.03);
  EXPECT_NEAR(r, std::cosh(1.0) + 0.11 * std::sinh(1.0), 0.005);
  EXPECT_NEAR(tangent(along).dot(place), 0.11, 2e-3);
}

/// The disc that turns about its body's centre stays as thick as it is.
TEST(Step, AWheelOfDiscsRollsAtTheHeightOfItsRim) {
  Trial run("gravity = [0, -10]\ntime = { dt = 0.02, until = 9 }\n" + material(0, 0.5) +
            "[shapes]\nball = { discs = [[-0.5, 0, 0.2], [0.5, 0, 0.2]] }\n"
            "[[walls]]\nsegment = [[-99, 0], [99, 0]]\n" +
            ball(0, 0.7, 0, 0, 60));
  double deepest = 0.0;
  for (int i = 0; i < 20; ++i) {
    run.steps(1);
    for (const double side : {-0.5, 0.5})
      deepest = std::max(deepest, 0.2 - (run.state.position[0].y() + side * std::sin(run.state.angle[0])));
  }
  EXPECT_LT(deepest, 0.03);
}

/// It happened: discs that can't turn gathered spin by rounding, which their state doesn't have.
TEST(Step, FollowsFromTheStateAlone) {
  const std::string one = ball(1, 10.222, 0, 0) + "[[walls]]\nsegment = [[0, 10], [20, 4]]\n";
  const std::string rain =
      "[[bodies]]\nshape = \"ball\"\ncount = 30\nplace.random.within = [[-4, 6], [4, 14]]\n"
      "[[walls]]\npolyline = [[-9, 6], [0, 0], [9, 6.5]]\n";
  for (const double friction : {0.0, 0.5})
    for (const std::string& bodies : {one, rain}) {
      Trial trial("gravity = [0, -9.81]\ntime = { dt = 0.01, until = 2 }\n" + material(0.0, friction) +
                  kDisc + bodies);
      for (int from = 0; from < 3; ++from) {
        trial.steps(40 + from);
        State other = trial.state;
        Workspace anew(trial.scene, trial.plan, 1);
        for (int i = 0; i < 25; ++i) {
          trial.steps(1), step(trial.scene, trial.plan, other, anew);
          ASSERT_EQ(hash(other), hash(trial.state)) << "in step " << other.step << " of\n" << bodies;
        }
      }
    }
}

}  // namespace
}  // namespace throng
