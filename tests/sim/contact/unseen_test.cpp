// SPDX-License-Identifier: MIT
// Who is struck gets farther in a step than it was looked for. The step is taken again where it meets
// somebody there, and only there.
#include "sim/contact/unseen.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/sim/trial.h"

namespace throng {
namespace {

constexpr double kSpeed = 20.0;  // m/s: 0.2 m in a step, of which one at rest is looked for in 0.05

/// A ball at the origin that is struck from the left as the first step begins, and what else there is.
std::string struck_from_left(const std::string& others) {
  return "gravity = [0, 0]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\n" + material(0.9, 0.5) +
         "[shapes]\nball = { disc = { radius = 0.5 } }\n"
         "box = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n" +
         ball(-1.001, 0, kSpeed, 0) + ball(0, 0, 0, 0) + others;
}

std::string box_beside(double x, double y) {
  return "[[bodies]]\nshape = \"box\"\nat = [" + std::to_string(x) + ", " + std::to_string(y) + "]\n";
}

std::uint64_t finds_in_first_step(Trial& run) {
  run.steps(1);
  EXPECT_NEAR(run.state.velocity[0].x(), 0.05 * kSpeed, 1e-6) << "has struck it";
  return run.work.candidates.finds();
}

TEST(Unseen, NobodyIsMetWhereNobodyIs) {
  for (const std::string& others :
       {std::string(), ball(0, 1.12, 0, 0), box_beside(0, -1.12), ball(1.35, 0, 0, 0), box_beside(1.35, 0),
        std::string("[[walls]]\nsegment = [[-3, 0.62], [3, 0.62]]\n"),
        std::string("[[walls]]\nsegment = [[0.85, -3], [0.85, 3]]\n")}) {
    Trial run(struck_from_left(others));
    EXPECT_EQ(finds_in_first_step(run), 1u) << others;
    EXPECT_NEAR(run.state.velocity[1].x(), 0.95 * kSpeed, 1e-6) << others;
  }
}

TEST(Unseen, WhoStandsInTheWayIsHitInTheSameStep) {
  for (const std::string& other : {ball(1.12, 0, 0, 0), box_beside(1.16, 0)}) {
    Trial run(struck_from_left(other));
    EXPECT_GT(finds_in_first_step(run), 1u) << other;
    run.steps(1);
    EXPECT_GT(run.state.velocity[2].x(), 0.7 * kSpeed) << other;
    EXPECT_LT(overlap(run.scene, run.state).max, 1e-9) << other;
  }
}

/// Whoever of two discs is larger: the stray's radius was once taken for that of both.
TEST(Unseen, AStrayMeetsALargerDisc) {
  Trial run("gravity = [0, 0]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\n" + material(0.9, 0) +
            "[shapes]\nball = { disc = { radius = 0.05 } }\nlarge = { disc = { radius = 0.5 } }\n" +
            ball(-0.101, 0, 40, 0) + ball(0, 0, 0, 0) + "[[bodies]]\nshape = \"large\"\nat = [0.4, 0.48]\n");
  run.steps(1);
  EXPECT_GT(run.work.candidates.finds(), 1u);
  EXPECT_LT(overlap(run.scene, run.state).max, 1e-9);
}

TEST(Unseen, WallsAndBordersThrowItBack) {
  for (const std::string& wall :
       {std::string("[[walls]]\nsegment = [[0.62, -3], [0.62, 3]]\n"),
        std::string("[[bodies]]\nshape = \"box\"\nkind = \"static\"\nat = [1.12, 0]\n"),
        std::string("[domain]\nbox = [[-9, -9], [0.62, 9]]\n")}) {
    Trial run(struck_from_left(wall));
    EXPECT_GT(finds_in_first_step(run), 1u) << wall;
    run.steps(1);
    EXPECT_LT(run.state.position[1].x(), 0.12 + 1e-9) << wall;
    EXPECT_LT(run.state.velocity[1].x(), 0.1) << wall;
  }
}

/// A rod that lies on its near end is struck onto its far one, which was too far away to be listed.
TEST(Unseen, TheFarEndOfWhatIsListedByItsNearOneIsStopped) {
  const std::string rod =
      "[shapes]\nball = { disc = { radius = 0.05 } }\n"
      "rod = { polygon = [[-0.5, -0.01], [0.5, -0.01], [0.5, 0.01], [-0.5, 0.01]] }\n"
      "slab = { polygon = [[-3, -1], [3, -1], [3, 0], [-3, 0]] }\n"
      "[[bodies]]\nshape = \"rod\"\nat = [0, 0.09]\nangle = 0.14\n" +
      ball(0.4, 0.225, 0, -40);
  for (const char* floor : {"[domain]\nbox = [[-9, 0], [9, 9]]\n", "[[walls]]\nsegment = [[-3, 0], [3, 0]]\n",
                            "[[bodies]]\nshape = \"slab\"\nat = [0, -0.5]\n"}) {
    Trial run("gravity = [0, 0]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\n" + material(0.0, 0.5) +
              rod + floor);
    run.steps(1);
    EXPECT_LT(run.state.angle[0], 0.1) << "is turned: " << floor;
    const double end = run.state.position[0].y() + 0.5 * std::sin(run.state.angle[0]);
    EXPECT_GT(end, 0.0) << floor;
  }
}

/// Who is struck in the midst of a step isn't where one who had been on his way from its beginning would be.
TEST(Unseen, WaysWithABendMeet) {
  Trial run("gravity = [0, 0]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\n" + material(0.9, 0.5) +
            "[shapes]\nball = { disc = { radius = 0.02 } }\n" + ball(-0.23, 0, 40, 0) + ball(0, 0, 0, 0) +
            ball(0.09, -0.285, 0, 0) + ball(0.09, -0.327, 0, 40));
  run.steps(1);
  EXPECT_GT(run.work.candidates.finds(), 1u);
}

/// As after an impulse beyond all bounds.
TEST(Unseen, WhoGotBeyondAllPlacesMayHaveMetAnybody) {
  Trial run(struck_from_left(""));
  run.steps(1);
  for (const double way : {1e13, 1e308, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_TRUE(
        run.work.unseen.met(std::array{Reached{1, way}}, run.state, run.work.bodies, run.work.contacts));
}

/// In a heap that falls hardly a step is taken again, though somebody is struck in most of them.
TEST(Unseen, AHeapIsHardlyTakenAgain) {
  Trial run(
      "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\nseed = 3\n" +
      material(0.1, 0.5) +
      "[domain]\nbox = [[0, 0], [12, 40]]\n[shapes]\nball = { disc = { radius = { uniform = [0.2, 0.4] } "
      "} }\n[[bodies]]\nshape = \"ball\"\ncount = 400\nvelocity = [0, -15]\nplace = { random = { within = "
      "[[0, 0], [12, 38]] "
      "} }\n");
  std::size_t strayed = 0;
  const int steps = 150;
  for (int i = 0; i < steps; ++i) {
    run.steps(1);
    strayed += !run.work.candidates.strays(run.work.bodies).empty();
  }
  EXPECT_GT(strayed, 20u);
  EXPECT_LT(run.work.candidates.finds() - steps, strayed / 3);  // 7 of 39, and others by chance
}

}  // namespace
}  // namespace throng
