// SPDX-License-Identifier: MIT
// Ways on which nothing but gravity and friction act are exact.
#include "sim/free_fall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/sim/trial.h"

namespace throng {
namespace {

const std::string kSlope =  // of 30 degrees
    "gravity = [5, -8.660254037844386]\n[[walls]]\nsegment = [[-9, 0], [99, 0]]\n";

std::string till_then(double dt) {
  return "time = { dt = " + std::to_string(dt) + ", until = 9 }\n";
}

TEST(FreeFall, WhoRollsOrSlidesStraightOnIsWhereHeShouldBe) {
  for (const double friction : {0.0, 0.1, 0.5})
    for (const double dt : {0.05, 0.01}) {
      Trial run(till_then(dt) + kSlope + material(0, friction) + kDisc + ball(0, 0.5, 0, 0));
      run.steps(static_cast<int>(std::lround(1.0 / dt)));
      const double slides = 5.0 - friction * 8.660254037844386, rolls = 2.0 / 3.0 * 5.0;
      EXPECT_NEAR(run.state.position[0].x(), 0.5 * std::max(slides, rolls), 1e-9) << friction << " " << dt;
    }
}

TEST(FreeFall, WhoIsSlowedDownIsToo) {
  for (const double dt : {0.05, 0.01}) {
    Trial run(till_then(dt) + kSlope + material(0, 0.8) +
              "[shapes]\nbox = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
              "[[bodies]]\nshape = \"box\"\nat = [0, 0.5]\nvelocity = [3, 0]\n");
    run.steps(static_cast<int>(std::lround(1.0 / dt)));
    EXPECT_NEAR(run.state.position[0].x(), 3.0 + 0.5 * (5.0 - 0.8 * 8.660254037844386), 1e-4) << dt;
  }
}

/// Who presses another and lets him go again falls as he does.
TEST(FreeFall, TwoThatMetStayTogether) {
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.157 * i, speed = 2.0 + 0.071 * i, dt = 0.02;
    const Vec at(std::cos(angle), std::sin(angle)), velocity = speed * at;
    Trial run("gravity = [0, -10]\ntime = { dt = 0.02, until = 9, substeps = 1 }\n" + material(0, 0) + kDisc +
              ball(0, 0, velocity.x(), velocity.y()) + ball(1.023 * at.x(), 1.023 * at.y(), 0, 0));
    run.steps(20);
    const double gap = (run.state.position[1] - run.state.position[0]).norm() - 1.0;
    EXPECT_LT(std::abs(gap), 0.1 * 0.5 * 10 * dt * dt) << i;
  }
}

/// Who is stopped where he has arrived is there.
TEST(FreeFall, WhoIsStoppedAtAFloorLiesOnIt) {
  for (int i = 0; i < 20; ++i) {
    Trial run("gravity = [0, -10]\ntime = { dt = 0.01, until = 9, substeps = 1 }\n" + material(0, 0) +
              "[shapes]\nbox = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
              "[[bodies]]\nshape = \"box\"\nat = [0, 0.75]\nvelocity = [0, -" +
              std::to_string(2.0 + 0.37 * i) + "]\n[[walls]]\nsegment = [[-9, 0], [9, 0]]\n");
    while (run.state.velocity[0].y() < -1.0) run.steps(1);
    EXPECT_NEAR(run.state.position[0].y(), 0.5, 1e-6) << i;
  }
}

/// What is off while one goes straight on makes up for what is off in the bends: Seams.OfABowlGiveNoEnergy.
TEST(FreeFall, WhoSlidesWhereThereAreBendsIsAheadByHalfASubstep) {
  Trial run(till_then(0.01) + "gravity = [5, -8.660254037844386]\n" + material(0, 0) + kDisc +
            ball(0, 0.5, 0, 0) + "[[walls]]\npolyline = [[-9, 0], [90, 0], [90, 9]]\n");
  run.steps(100);
  const double h = run.scene.time.dt / run.scene.time.substeps;
  EXPECT_NEAR(run.state.position[0].x(), 0.5 * 5.0 + 0.5 * 5.0 * h, 1e-9);
}

}  // namespace
}  // namespace throng
