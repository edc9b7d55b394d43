// SPDX-License-Identifier: MIT
// However fast something is, it passes nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/stability/masonry.h"

namespace throng {
namespace {

std::string head(double restitution, double friction = 0.5) {
  return "time = { dt = 0.0166666666666666667, until = 1 }\n" + material(restitution, friction) +
         "[shapes]\nball = { disc = { radius = 0.1 } }\n"
         "bar = { polygon = [[-2, -0.025], [2, -0.025], [2, 0.025], [-2, 0.025]] }\n"
         "plate = { polygon = [[-0.01, -3], [0.01, -3], [0.01, 3], [-0.01, 3]] }\n"
         "stone = { polygon = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]] }\n";
}

std::string body(const std::string& shape, const Vec& at, const Vec& velocity, const std::string& more = "") {
  std::ostringstream out;
  out.precision(17);
  out << "[[bodies]]\nshape = \"" << shape << "\"\nat = [" << at.x() << ", " << at.y() << "]\nvelocity = ["
      << velocity.x() << ", " << velocity.y() << "]\n"
      << more;
  return out.str();
}

class Fast : public ::testing::TestWithParam<double> {};  // restitution

TEST_P(Fast, ADiscPassesNoWallSegment) {
  for (int i = 0; i < 40; ++i) {
    const double slant = -1.2 + 0.06 * i, x = -1.0 - 0.0831 * i;
    Trial run(head(GetParam()) +
              body("ball", {x, -x * std::tan(slant) * 0.1}, {200 * std::cos(slant), 200 * std::sin(slant)}) +
              "[[walls]]\nsegment = [[0, -1000], [0, 1000]]\n");
    for (int step = 0; step < 20; ++step) {
      run.steps(1);
      ASSERT_LT(run.state.position[0].x(), 0.0) << "slant " << slant << ", step " << step;
    }
  }
}

TEST_P(Fast, TwoThatMeetDontPassEachOther) {
  for (const std::string shape : {"ball", "stone"})
    for (int i = 0; i < 20; ++i) {
      Trial run(head(GetParam(), 0.0) + body(shape, {-1.0 - 0.0731 * i, 0}, {200, 0}) +
                body(shape, {1.0, 0}, {-200, 0}));
      for (int step = 0; step < 10; ++step) {
        run.steps(1);
        ASSERT_LT(run.state.position[0].x(), run.state.position[1].x()) << shape << " " << i;
      }
    }
}

TEST_P(Fast, AThinPlateThatIsDrivenTakesAllAlong) {
  for (const std::string shape : {"ball", "stone"})
    for (int i = 0; i < 20; ++i) {
      Trial run(head(GetParam()) + body("plate", {-2.0 - 0.0531 * i, 0}, {100, 0}, "kind = \"kinematic\"\n") +
                body(shape, {0, 0.1}, {-100, 0}));
      for (int step = 0; step < 20; ++step) {
        run.steps(1);
        ASSERT_LT(run.state.position[0].x(), run.state.position[1].x()) << shape << " " << i;
      }
    }
}

/// At 20 rad/s the bar's end gets 0.67 m in a step.
TEST_P(Fast, ABarThatIsTurnedHitsWhateverStandsInItsWay) {
  for (const std::string shape : {"ball", "stone"})
    for (const double spin : {5.0, 10.0, 20.0})
      for (int i = 1; i < 20; ++i) {
        const double angle = 0.08 * i;
        Trial run(head(GetParam(), 0.0) +
                  body("bar", {0, 0}, {0, 0}, "kind = \"kinematic\"\nspin = " + std::to_string(spin) + "\n") +
                  body(shape, {1.7 * std::cos(angle), 1.7 * std::sin(angle)}, {0, 0}));
        run.steps(static_cast<int>(std::ceil((angle + 0.5) / spin * 60)));
        EXPECT_GT(run.state.velocity[1].norm(), 0.5 * spin * 1.7)
            << shape << " spin " << spin << " at " << angle;
      }
}

/// Of a bar that falls on a wall without thickness, or turns as it falls, no corner gets through.
TEST_P(Fast, ABarThatTurnsPassesNoWall) {
  for (const double spin : {-12.0, -6.0, -3.0, 0.0, 3.0, 6.0, 12.0})
    for (int i = 0; i < 10; ++i) {
      Trial run("gravity = [0, -9.81]\n" + head(GetParam()) +
                body("bar", {0, 2.2}, {0, -0.5 * i},
                     "angle = " + std::to_string(0.3 * i) + "\nspin = " + std::to_string(spin) + "\n") +
                "[[walls]]\nsegment = [[-100, 0], [100, 0]]\n");
      double lowest = 0.0;
      for (int step = 0; step < 120; ++step) {
        run.steps(1);
        for (const Vec& v : run.scene.shapes[1].parts[0].vertices)
          lowest = std::min(lowest, (narrowphase::pose(run.state.position[0], run.state.angle[0]) * v).y());
      }
      EXPECT_GT(lowest, -0.02) << "spin " << spin << " " << i;
    }
}

/// A bar at rest that a stone hits at its right end: the left one turns towards a wall behind it, which
/// nobody looked for when the step began, though its centre stays where it was looked for. As thick as the
/// bar is, a corner that is stopped without bouncing may be in the wall at first.
TEST_P(Fast, ABarThatIsSetTurningPassesNoWall) {
  for (const double behind : {0.25, 0.3, 0.4})
    for (int speed = 30; speed <= 200; speed += 10) {
      Trial run(head(GetParam(), 0.0) + body("bar", {0, 0}, {0, 0}) +
                body("stone", {1.89, -0.13}, {0, static_cast<double>(speed)}) +
                "[[walls]]\nsegment = [[-1000, " + std::to_string(-behind) + "], [-0.5, " +
                std::to_string(-behind) + "]]\n");
      for (int step = 0; step < 4; ++step) {
        run.steps(1);
        for (const Vec& v : run.scene.shapes[1].parts[0].vertices) {
          const Vec corner = narrowphase::pose(run.state.position[0], run.state.angle[0]) * v;
          if (corner.x() < -0.6) {
            EXPECT_GT(corner.y(), -behind - 0.05) << speed << " m/s, " << behind << " m, step " << step;
          }
        }
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Restitution, Fast, ::testing::Values(0.0, 0.5, 1.0));

}  // namespace
}  // namespace throng
