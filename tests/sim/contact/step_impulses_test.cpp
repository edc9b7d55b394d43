// SPDX-License-Identifier: MIT
// Contacts that are recorded tell all that acts in a step: their impulses are what momentum changes by.
#include "sim/contact/step_impulses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>

#include "narrowphase/convex.h"
#include "sim/simulation.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

const std::string kRecords = "[record]\nfields = [\"position\", \"contacts\"]\n";
const char* const kShapes =
    "[shapes]\ndisc = { disc = { radius = 0.5 } }\n"
    "box = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n";

std::string frictionless(double restitution) {
  return "[materials.default]\nfriction = 0\nrestitution = " + std::to_string(restitution) + "\n" + kShapes;
}

std::string placed(const std::string& shape, const std::string& more) {
  return "[[bodies]]\nshape = \"" + shape + "\"\n" + more;
}

/// The largest difference (N s) between what contacts press a body along `axis` in a step and what its
/// momentum changes by, less gravity's part; and how much they press in all.
struct Balance {
  double off = 0.0, pressed = 0.0;
};

/// What a contact presses the body along the axis. Whoever is ahead of another stays so.
double push(const ContactRow& row, std::size_t body, const Simulation& run, int axis) {
  const std::uint32_t id = static_cast<std::uint32_t>(body + 1);
  if (row.a != id && row.b != id) return 0.0;
  const double from = row.b == 0 ? row.point[axis] : run.state().position[row.a + row.b - id - 1][axis];
  return from < run.state().position[body][axis] ? row.impulse : -row.impulse;
}

/// Of bodies in a row along the axis, without friction.
Balance balance(const Scene& scene, int axis) {
  const std::unique_ptr<Simulation> run = simulation(scene);
  Balance result;
  std::vector<ContactRow> rows;
  for (int step = 0; step < scene.time.steps(); ++step) {
    const State before = run->state();
    run->step();
    run->list_contacts(rows);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      double pressed = 0.0;
      for (const ContactRow& row : rows) pressed += push(row, i, *run, axis);
      const double falls = scene.gravity[axis] * scene.time.dt;
      const double gains =
          mass(scene, i) * (run->state().velocity[i][axis] - before.velocity[i][axis] - falls);
      result.off = std::max(result.off, std::abs(pressed - gains));
      result.pressed += std::abs(pressed);
    }
  }
  return result;
}

void expect_balanced(const std::string& text, int axis, double least) {
  const Balance found = balance(scene_from(text + kRecords), axis);
  EXPECT_LT(found.off, 1e-11 * found.pressed) << text;
  EXPECT_GT(found.pressed, least) << text;
}

/// Three hit one another, and the last one a wall: what hits is stopped before the sweeps.
TEST(StepImpulses, AreWhatMomentumChangesByWhereNothingFalls) {
  for (const double restitution : {0.0, 0.3, 1.0})
    for (const char* shape : {"disc", "box"})
      expect_balanced("time = { dt = 0.01, until = 3, substeps = 4 }\n" + frictionless(restitution) +
                          "[[walls]]\nsegment = [[4, -2], [4, 2]]\n" +
                          placed(shape, "at = [0, 0]\nvelocity = [5, 0]\n") +
                          placed(shape, "at = [1.5, 0]\n") + placed(shape, "at = [2.5, 0]\n"),
                      0, 5.0);
}

TEST(StepImpulses, AreWhatMomentumChangesByWhereBodiesLand) {
  for (const double restitution : {0.0, 0.5})
    for (const char* shape : {"disc", "box"})
      expect_balanced("gravity = [0, -9.81]\nsleep = false\ntime = { dt = 0.02, until = 3 }\n" +
                          frictionless(restitution) + "[[walls]]\nsegment = [[-5, 0], [5, 0]]\n" +
                          placed(shape, "at = [0, 1]\n") + placed(shape, "at = [0, 3]\n"),
                      1, 30.0);
}

/// Along a plank, so fast that what touches there is forgotten before it relaxes.
TEST(StepImpulses, AreWhatMomentumChangesByWhereBodiesGetElsewhere) {
  expect_balanced(
      "gravity = [0, -9.81]\nsleep = false\ntime = { dt = 0.01, until = 0.3 }\n" + frictionless(0.3) +
          "plank = { polygon = [[-100, -0.5], [100, -0.5], [100, 0.5], [-100, 0.5]] }\n"
          "[[walls]]\nsegment = [[-200, 0], [200, 0]]\n" +
          placed("plank", "at = [0, 0.5]\n") + placed("box", "at = [-45, 1.52]\nvelocity = [300, 0]\n"),
      1, 5.0);
}

/// Under guard: so fast that it would be through the wall.
TEST(StepImpulses, AreWhatMomentumChangesByUnderGuard) {
  expect_balanced("time = { dt = 0.05, until = 0.5 }\n" + frictionless(0.0) +
                      "[[walls]]\nsegment = [[4, -2], [4, 2]]\n" +
                      placed("box", "at = [0, 0]\nvelocity = [300, 0]\n") +
                      placed("box", "at = [-3, 0]\nvelocity = [400, 0]\n"),
                  0, 200.0);
}

/// Under guard, where who was held before goes on as one with whom he meets: of what threw them apart some is
/// taken back.
TEST(StepImpulses, AreWhatMomentumChangesByOfThoseThatGoOnAsOne) {
  struct Disc {
    double x, velocity;
    bool heavy;
  };
  std::ostringstream discs;
  for (const Disc& disc : {Disc{1.34, -276, true},
                           {2.01, 281, true},
                           {2.86, 3, true},
                           {3.34, 71, true},
                           {5.93, -114, false},
                           {7.49, -17, false},
                           {8.12, 67, false},
                           {10.23, -34, true},
                           {10.67, -244, true},
                           {11.7, 67, true},
                           {12.25, 122, false},
                           {12.77, -157, false},
                           {13.99, -245, true},
                           {15.44, -235, true}})
    discs << placed("small", disc.heavy ? "material = \"heavy\"\n" : "") << "at = [" << disc.x
          << ", 0]\nvelocity = [" << disc.velocity << ", 0]\n";
  expect_balanced("time = { dt = 0.05, until = 0.05 }\n" + frictionless(0.7) +
                      "small = { disc = { radius = 0.2 } }\n[materials.heavy]\ndensity = 1000\nfriction = "
                      "0\nrestitution = 0.7\n" +
                      discs.str(),
                  0, 200.0);
}

/// Of a body of those corners, the second one of the scene: how far (m) contacts are from the nearest, at
/// most.
double farthest_from_corners(const Scene& scene, double width, double height) {
  const std::unique_ptr<Simulation> run = simulation(scene);
  std::vector<ContactRow> rows;
  double farthest = -1.0;
  for (int step = 0; step < scene.time.steps(); ++step) {
    run->step();
    run->list_contacts(rows);
    const narrowphase::Pose pose = narrowphase::pose(run->state().position[1], run->state().angle[1]);
    for (const ContactRow& row : rows) {
      double nearest = 1.0;
      for (const double x : {-0.5 * width, 0.5 * width})
        for (const double y : {-0.5 * height, 0.5 * height})
          nearest = std::min(nearest, (pose * Vec(x, y) - row.point).norm());
      farthest = std::max(farthest, nearest);
    }
  }
  EXPECT_GE(farthest, 0.0) << "there was none";
  return farthest;
}

/// A box pivots on a blade that is driven, or goes along with it. Where contacts are felt along a face isn't
/// where they are.
TEST(StepImpulses, ActWhereBodiesTouch) {
  const std::string head =
      frictionless(0.0) +
      "blade = { polygon = [[-3, -0.01], [3, -0.01], [3, 0.01], [-3, 0.01]] }\n"
      "brick = { polygon = [[-0.3, -0.15], [0.3, -0.15], [0.3, 0.15], [-0.3, 0.15]] }\n" +
      kRecords + placed("blade", "at = [0, 0]\nkind = \"kinematic\"\n");
  const std::string time = "time = { dt = 0.016666666666666667, until = 0.25, substeps = 4 }\n";
  EXPECT_LT(
      farthest_from_corners(
          scene_from("gravity = [0, -9.81]\n" + time + head + "spin = 0.31\n" +
                     placed("brick", "at = [0.5, 0.36]\nangle = 0.9\nspin = -12\nvelocity = [0, -1]\n")),
          0.6, 0.3),
      1e-3);
  EXPECT_LT(
      farthest_from_corners(scene_from(time + head + "spin = 6\n" +
                                       placed("brick", "at = [1, 0.16]\nspin = 6\nvelocity = [-0.96, 6]\n")),
                            0.6, 0.3),
      0.1)
      << "a substep's way";
}

/// And not where bodies are by the end of the step, who go on as they bounce.
TEST(StepImpulses, AreWhereBodiesBounced) {
  for (const char* there :
       {"[[walls]]\nsegment = [[4, -9], [4, 9]]\n", "[domain]\nbox = [[-9, -9], [4, 9]]\n"})
    for (const char* shape : {"disc", "box"})
      for (const double restitution : {0.0, 0.5, 1.0}) {
        const Scene scene =
            scene_from("time = { dt = 0.01, until = 0.06 }\n" + frictionless(restitution) + there +
                       placed(shape, "at = [0, 0]\nvelocity = [100, 30]\n") + kRecords);
        const std::unique_ptr<Simulation> run = simulation(scene);
        std::vector<ContactRow> rows;
        std::size_t told = 0;
        for (int step = 0; step < 6; ++step) {
          run->step();
          run->list_contacts(rows);
          told += rows.size();
          for (const ContactRow& row : rows) {
            EXPECT_NEAR(row.point.x(), 4.0, restitution > 0.0 ? 1e-9 : 0.01) << there << shape << restitution;
            EXPECT_NEAR(row.point.y(), 30.0 * 3.5 / 100.0, 0.58) << there << shape << restitution;
          }
        }
        EXPECT_GT(told, 0u) << there << shape << restitution;
      }
}

TEST(StepImpulses, LeaveToThoseThatPressAtTheEndWhatIsCounted) {
  const Scene scene = scene_from("time = { dt = 0.1, until = 1 }\n" + frictionless(1.0) +
                                 placed("disc", "at = [0, 0]\nvelocity = [20, 0]\n") +
                                 placed("disc", "at = [2, 0]\n") + kRecords);
  const std::unique_ptr<Simulation> run = simulation(scene);
  run->step();
  std::vector<ContactRow> rows;
  run->list_contacts(rows);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_FALSE(rows[0].presses);
  EXPECT_EQ(run->contacts(), 0u);
}

}  // namespace
}  // namespace throng
