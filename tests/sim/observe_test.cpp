// SPDX-License-Identifier: MIT
#include "sim/observe.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/sim/scene_from.h"

namespace throng {
namespace {

TEST(Observe, OverlapMeasuresBodiesWallsAndTheBox) {
  Scene scene = scene_from(
      "domain = { box = [[0, 0], [20, 20]] }\n[shapes]\nball = { disc = { radius = 1 } }\n"
      "block = { polygon = [[0, 0], [2, 0], [2, 2], [0, 2]] }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [5, 5]\n"
      "[[bodies]]\nshape = \"ball\"\nat = [6.9, 5]\n"  // 0.1 deep in the first
      "[[bodies]]\nshape = \"block\"\nat = [10, 1]\n"
      "[[bodies]]\nshape = \"ball\"\nat = [15, 15.97]\n"  // 0.03 deep in the wall
      "[[walls]]\nsegment = [[13, 15], [17, 15]]\n");
  scene.bodies.position[2].y() = 0.98;  // 0.02 deep in the floor
  const Overlap o = overlap(scene, initial_state(scene));
  EXPECT_EQ(o.pairs, 3u);
  EXPECT_NEAR(o.max, 0.1, 1e-12);
  EXPECT_NEAR(o.mean, 0.05, 1e-12);
}

TEST(Observe, NothingOverlapsWhereNothingTouches) {
  const Scene scene = scene_from(
      "[shapes]\nball = { disc = { radius = 1 } }\n[[bodies]]\nshape = \"ball\"\nat = [5, 5]\n"
      "[[bodies]]\nshape = \"ball\"\nat = [7, 5]\n");
  const Overlap o = overlap(scene, initial_state(scene));
  EXPECT_EQ(o.pairs, 0u);
  EXPECT_EQ(o.max, 0.0);
  EXPECT_EQ(o.mean, 0.0);
}

/// The step's caution, which looks as far as bodies fly, once ended runs that were over.
TEST(Observe, OverlapIsToldHoweverFastBodiesAre) {
  const Scene scene = scene_from(
      "contact = { model = \"none\" }\ntime = { dt = 0.01, until = 1 }\n"
      "domain = { periodic = [[0, 0], [4, 4]] }\n[shapes]\nball = { disc = { radius = 0.5 } }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [0.1, 1]\nvelocity = [150, 0]\n"
      "[[bodies]]\nshape = \"ball\"\nat = [3.9, 1]\n");
  EXPECT_NEAR(overlap(scene, initial_state(scene)).max, 0.8, 1e-12);
}

TEST(Observe, EnergyAndMomentumAreThoseOfDynamicBodies) {
  const Scene scene = scene_from(
      "gravity = [0, -10]\n[materials.default]\ndensity = 2\n[shapes]\nball = { disc = { radius = 1 } }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [0, 3]\nvelocity = [1, 2]\nspin = 4\n"
      "[[bodies]]\nshape = \"ball\"\nat = [9, 9]\nvelocity = [5, 5]\nkind = \"kinematic\"\n");
  const State state = initial_state(scene);
  const double m = 2 * std::numbers::pi;
  EXPECT_NEAR(kinetic_energy(scene, state), 0.5 * m * 5 + 0.5 * (0.5 * m) * 16, 1e-12);
  EXPECT_NEAR(potential_energy(scene, state), m * 10 * 3, 1e-12);
  EXPECT_NEAR(momentum(scene, state).x(), m, 1e-12);
  EXPECT_NEAR(momentum(scene, state).y(), 2 * m, 1e-12);
}

}  // namespace
}  // namespace throng
