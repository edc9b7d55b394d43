// SPDX-License-Identifier: MIT
// Two that bounce off each other alone do so when they meet, whatever the step.
#include "sim/contact/lone_bounce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/sim/trial.h"

namespace throng {
namespace {

std::string in_steps_of(double dt, int substeps) {
  return "time = { dt = " + std::to_string(dt) + ", until = 9, substeps = " + std::to_string(substeps) +
         " }\n";
}

/// m, of a point that falls from `height` and bounces, after `t` (s).
double bouncing(double height, double g, double restitution, double t) {
  double up = 0.0, flight = std::sqrt(2.0 * height / g);  // m/s at the flight's begin, and how long it lasts
  while (t > flight) {
    t -= flight;
    up = restitution * (g * flight - up);
    flight = 2.0 * up / g;
    height = 0.0;
  }
  return height + up * t - 0.5 * g * t * t;
}

TEST(LoneBounce, IsOnTimeWhileADiscBounces) {
  for (const double dt : {0.02, 0.01, 0.004})
    for (const double restitution : {1.0, 0.8}) {
      Trial run("gravity = [0, -10]\n" + in_steps_of(dt, 1) + material(restitution, 0) + kDisc +
                ball(0, 1.5, 0.7, 0) + "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n");
      for (double t = dt; t < 2.5; t += dt) {
        run.steps(1);
        ASSERT_NEAR(run.state.position[0].y() - 0.5, bouncing(1.0, 10, restitution, t), 1e-11)
            << dt << " " << t;
      }
      EXPECT_NEAR(run.state.position[0].x(), 0.7 * dt * static_cast<double>(run.state.step), 1e-11);
    }
}

/// At any speed: the shorter the step, the slower it seems.
TEST(LoneBounce, OffWhatIsRoundIsWhereTheyMeet) {
  struct Round {
    const char* text;
    double apart;  // m, of its middle and the ball's when they meet
  };
  const Round disc{"[[bodies]]\nshape = \"ball\"\nat = [0, 0]\nkind = \"static\"\n", 1.0},
      end{"[[walls]]\nsegment = [[0, -5], [0, 0]]\n", 0.5};
  const double g = 10.0, fall = 1.0, until = 0.6;
  for (const Round& round : {disc, end})
    for (const double dt : {0.01, 0.001, 1e-4}) {
      const Vec normal(0.6, 0.8), meets = round.apart * normal;
      Trial run("gravity = [0, -10]\n" + in_steps_of(dt, 1) + material(0.8, 0) + kDisc +
                ball(meets.x(), meets.y() + fall, 0, 0) + round.text);
      run.steps(static_cast<int>(std::lround(until / dt)));
      const double met = std::sqrt(2.0 * fall / g), t = until - met;
      const Vec before(0.0, -g * met);
      const Vec after = before - 1.8 * before.dot(normal) * normal, falls(0.0, -g);
      EXPECT_LT((run.state.position[0] - meets - t * after - 0.5 * t * t * falls).norm(), 1e-10)
          << round.text << dt;
    }
}

/// Off their line of centres, and slowly, so that nobody looks ahead for where they meet.
TEST(LoneBounce, OfTwoDiscsIsWhereTheyMeet) {
  const double aside = 0.6;  // m, of diameter 1
  for (const double dt : {0.05, 0.01, 0.002}) {
    Trial run("gravity = [0, -10]\n" + in_steps_of(dt, 1) + material(1, 0) + kDisc + ball(0, 0, 1, 0) +
              ball(1.237, aside, -1, 0));
    run.steps(static_cast<int>(std::lround(1.0 / dt)));
    const Vec normal(std::sqrt(1.0 - aside * aside), aside), before(1.0, 0.0);
    const double met = 0.5 * (1.237 - normal.x());
    const Vec after = before - 2.0 * before.dot(normal) * normal;  // of the first one, by symmetry
    const Vec fallen(0.0, -5.0), falls(0.0, -10.0);                // in a second
    EXPECT_LT((run.state.velocity[0] - after - falls).norm(), 1e-12) << dt;
    EXPECT_LT((run.state.position[0] - (met * before + (1.0 - met) * after) - fallen).norm(), 1e-12) << dt;
  }
}

TEST(LoneBounce, OfATurningSquareIsThatOfShorterSteps) {
  const auto landed = [](int substeps) {
    Trial run("gravity = [0, -10]\n" + in_steps_of(0.01, substeps) + material(0.7, 0.4) +
              "[shapes]\nbox = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
              "[[bodies]]\nshape = \"box\"\nat = [0, 1.2]\nangle = 0.3\nspin = 4\nvelocity = [1, 0]\n"
              "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n");
    run.steps(45);
    return std::pair(run.state.position[0], Vec(run.state.velocity[0] + Vec(run.state.spin[0], 0.0)));
  };
  const auto [coarse_place, coarse] = landed(1);
  const auto [fine_place, fine] = landed(64);
  EXPECT_GT(fine.y(), 0.5) << "it bounces";
  EXPECT_LT((coarse_place - fine_place).norm(), 1e-9);
  EXPECT_LT((coarse - fine).norm(), 1e-9);
}

/// Who meets a second one in the same substep bounces off both at once: he gets through neither, and keeps
/// his energy.
TEST(LoneBounce, IsNoneWhereTwoAreMet) {
  for (const double left : {0.01, 0.03, 0.1, 0.14}) {
    Trial run("gravity = [0, -10]\n" + in_steps_of(0.05, 1) + material(1, 0) + kDisc + ball(0, 0.53, 3, -3) +
              "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n[[walls]]\nsegment = [[" + std::to_string(0.5 + left) +
              ", 0], [" + std::to_string(0.5 + left) + ", 9]]\n");
    const double before = run.energy();
    for (int i = 0; i < 6; ++i) {
      run.steps(1);
      ASSERT_NEAR(run.energy(), before, 1e-9 * before) << left << " " << i;
      ASSERT_GT(run.state.position[0].y(), 0.5 - 1e-9) << left << " " << i;
      ASSERT_LT(run.state.position[0].x(), left + 1e-9) << left << " " << i;
    }
  }
}

TEST(LoneBounce, IsNoneOfThree) {
  Trial run("gravity = [0, -10]\n" + in_steps_of(0.05, 1) + material(1, 0) +
            "[shapes]\nball = { disc = { radius = 0.5 } }\nbig = { disc = { radius = 1 } }\n" +
            "[[bodies]]\nshape = \"big\"\nat = [0, 0]\nvelocity = [3, 0]\n" + ball(1.4, 0.7, 0, 0) +
            ball(1.4, -0.7, 0, 0));
  const double before = run.energy();
  run.steps(1);
  EXPECT_GT(run.state.velocity[1].x(), 0.5);
  EXPECT_GT(run.state.velocity[2].x(), 0.5);
  EXPECT_NEAR(run.energy(), before, 1e-9 * before);
}

/// On his true way he would get into a wall, of which he stays clear if he bounces as the substep begins.
TEST(LoneBounce, GoesNowhereNearAThird) {
  Trial run("gravity = [0, -10]\n" + in_steps_of(0.02, 1) + material(1, 0) + kDisc + ball(0, 0, 20, 0) +
            ball(1.3, 0, 0, 0) + "[[walls]]\nsegment = [[0.6, 0.1], [0.6, 5]]\n");
  for (int i = 0; i < 5; ++i) {
    run.steps(1);
    const Vec from = run.state.position[0] - Vec(0.6, 0.1);
    EXPECT_GT(from.y() > 0.0 ? std::abs(from.x()) : from.norm(), 0.5 - 1e-3) << i;
  }
}

/// Of an elastic ball, and a box that is stopped elsewhere in the same substep.
TEST(LoneBounce, IsOnTimeWhereOthersAreStopped) {
  Trial run(
      "gravity = [0, -10]\n" + in_steps_of(0.02, 1) +
      "[materials.soft]\nrestitution = 0\nfriction = 0\n[materials.bouncy]\nrestitution = 1\nfriction = 0\n"
      "[shapes]\nb = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
      "c = { disc = { radius = 0.5 } }\n[[bodies]]\nshape = \"c\"\nmaterial = \"bouncy\"\nat = [0, 1.5]\n"
      "[[bodies]]\nshape = \"b\"\nmaterial = \"soft\"\nat = [50, 1.5]\n"
      "[[walls]]\nsegment = [[-100, 0], [100, 0]]\nmaterial = \"soft\"\n");
  run.steps(40);
  EXPECT_NEAR(run.state.position[0].y() - 0.5, bouncing(1.0, 10, 1.0, 0.8), 1e-11);
  EXPECT_NEAR(run.state.position[1].y(), 0.5, 4e-3) << "it sags";
}

/// A bar that lands nearly flat meets the floor with its other end soon after.
TEST(LoneBounce, LetsNobodyThroughWhoMeetsAgainWithinTheSubstep) {
  for (const double angle : {0.002, 0.005, 0.01, 0.02, 0.04}) {
    Trial run("gravity = [0, -10]\n" + in_steps_of(0.02, 1) + material(0.5, 0) +
              "[shapes]\nbar = { polygon = [[-1, -0.05], [1, -0.05], [1, 0.05], [-1, 0.05]] }\n"
              "[[bodies]]\nshape = \"bar\"\nat = [0, 0.3]\nvelocity = [0, -4]\nangle = " +
              std::to_string(angle) + "\n[[walls]]\nsegment = [[-9, 0], [9, 0]]\n");
    for (int i = 0; i < 12; ++i) {
      run.steps(1);
      const double turn = run.state.angle[0];
      const double low = run.state.position[0].y() - std::abs(std::sin(turn)) - 0.05 * std::cos(turn);
      ASSERT_GT(low, -0.005) << angle << " " << i;
    }
  }
}

/// Its end may dip into the floor and be out again, or turn away there, before anybody looks.
TEST(LoneBounce, IsNoneOfWhatTurnsFarInASubstep) {
  for (int i = 0; i < 40; ++i) {
    Trial run("gravity = [0, -10]\n" + in_steps_of(0.01, 1) + material(0.5, 0) +
              "[shapes]\nbar = { polygon = [[-0.5, -0.05], [0.5, -0.05], [0.5, 0.05], [-0.5, 0.05]] }\n"
              "[[bodies]]\nshape = \"bar\"\nat = [0, 0.7]\nvelocity = [0, -15]\nspin = " +
              std::to_string(40 + i) + "\nangle = " + std::to_string(0.15 * i) +
              "\n[[walls]]\nsegment = [[-9, 0], [9, 0]]\n");
    for (int k = 0; k < 6; ++k) {
      run.steps(1);
      const double turn = run.state.angle[0];
      const double low =
          run.state.position[0].y() - 0.5 * std::abs(std::sin(turn)) - 0.05 * std::abs(std::cos(turn));
      EXPECT_GT(low, -1e-6) << i << " " << k;
    }
  }
}

}  // namespace
}  // namespace throng
