// SPDX-License-Identifier: MIT
#include "sim/engine_box2d.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/observe.h"
#include "tests/sim/scene_from.h"

namespace throng {
namespace {

using ::testing::HasSubstr;

const char* const kOneBall =
    "[shapes]\nball = { disc = { radius = 0.5 } }\n[[bodies]]\nshape = \"ball\"\nat = [0, 2]\n";

TEST(Box2dEngine, RefusesWhatBox2dCannotDoAndSaysWhy) {
  EXPECT_THAT(
      engine_refusal(Engine::box2d, std::string("domain = { periodic = [[-9, -9], [9, 9]] }\n") + kOneBall),
      HasSubstr("periodic"));
  const std::string rolling = "[materials.default]\nrolling_resistance = 0.1\n";
  EXPECT_THAT(engine_refusal(Engine::box2d, rolling + kOneBall),
              HasSubstr("materials.default.rolling_resistance"));
  const std::string ice = "[materials.ice]\nfriction = 0\n" + std::string(kOneBall) + "material = \"ice\"\n";
  EXPECT_EQ(engine_refusal(Engine::box2d, rolling + ice), "") << "nobody is of the default";
  EXPECT_THAT(engine_refusal(Engine::box2d, "domain = { box = [[-9, -9], [9, 9]] }\n" + rolling + ice),
              HasSubstr("materials.default.rolling_resistance"));
  EXPECT_THAT(engine_refusal(Engine::box2d, std::string("contact = { model = \"none\" }\n") + kOneBall),
              HasSubstr("contact.model"));
  EXPECT_THAT(
      engine_refusal(Engine::box2d,
                     "[shapes]\nchip = { polygon = [[0, 0], [0.004, 0], [0.004, 0.004], [0, 0.004]] }\n"
                     "[[bodies]]\nshape = \"chip\"\nat = [0, 2]\n"),
      HasSubstr("shapes.chip"));
}

TEST(Box2dEngine, KnowsTheMassOfEveryShape) {
  // A composite whose discs overlap weighs what its union weighs: dropped beside a disc, both fall alike, and
  // what they carry into a collision is what the native engine says.
  const std::string text =
      "[materials.default]\nrestitution = 1\nfriction = 0\n"
      "[shapes]\nball = { disc = { radius = 0.5 } }\npair = { discs = [[0, 0, 0.5], [0.4, 0, 0.5]] }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [-3, 0]\nvelocity = [2, 0]\n"
      "[[bodies]]\nshape = \"pair\"\nat = [0, 0]\n";
  const Scene native_scene = scene_from(text), box2d_scene = scene_from("engine = \"box2d\"\n" + text);
  const auto native = simulation(native_scene), box2d = simulation(box2d_scene);
  for (int i = 0; i < 200; ++i) native->step(), box2d->step();
  for (std::size_t i : {0, 1})
    EXPECT_NEAR(native->state().velocity[i].x(), box2d->state().velocity[i].x(), 0.02) << "body " << i;
}

TEST(Box2dEngine, LetsADiscRestOnTheFloorOfTheBox) {
  const Scene scene = scene_from(
      std::string("engine = \"box2d\"\ngravity = [0, -10]\ndomain = { box = [[-5, 0], [5, 9]] }\n") +
      kOneBall);
  const auto run = simulation(scene);
  for (int i = 0; i < 500; ++i) run->step();
  EXPECT_NEAR(run->state().position[0].y(), 0.5, 0.02);
  EXPECT_EQ(run->contacts(), 1u);
}

TEST(Box2dEngine, CutsPolygonsOfManyCorners) {
  // A polygon of 20 corners rolls on as one rigid body, on the circle through them.
  std::string corners;
  for (int i = 0; i < 20; ++i) {
    const narrowphase::Pose turn = narrowphase::pose({0.0, 0.0}, 0.31415926535897931 * i);
    corners += (i ? ", [" : "[") + std::to_string(turn.cos) + ", " + std::to_string(turn.sin) + "]";
  }
  const Scene scene = scene_from(
      "engine = \"box2d\"\ngravity = [0, -10]\ndomain = { box = [[-5, 0], [5, 9]] }\n[shapes]\nwheel = { "
      "polygon = [" +
      corners + "] }\n[[bodies]]\nshape = \"wheel\"\nat = [0, 3]\n");
  const auto run = simulation(scene);
  for (int i = 0; i < 500; ++i) run->step();
  EXPECT_NEAR(run->state().position[0].y(), 0.99, 0.03);
}

TEST(Box2dEngine, EndsTheRunWhereItWouldSlowABodyDown) {
  const Scene scene = scene_from(
      "engine = \"box2d\"\ntime = { dt = 0.01, until = 1 }\n[shapes]\nball = { disc = { radius = 0.5 } }\n"
      "[[bodies]]\nshape = \"ball\"\nat = [0, 2]\nvelocity = [1000, 0]\n");
  const auto run = simulation(scene);
  EXPECT_THROW(run->step(), SimulationError);
}

class BothEngines : public ::testing::TestWithParam<const char*> {};

TEST_P(BothEngines, RunTheSceneWithoutLosingABody) {
  Scene scene = gallery_scene(GetParam());
  for (Engine engine : {Engine::native, Engine::box2d}) {
    scene.engine = engine;
    const auto run = simulation(scene);
    for (int i = 0; i < 30; ++i) run->step();
    for (const Vec& p : run->state().position) {
      EXPECT_TRUE((p.array() >= scene.domain.min.array()).all() &&
                  (p.array() <= scene.domain.max.array()).all());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Gallery, BothEngines,
                         ::testing::Values("pyramid", "hopper", "gears", "billiard", "mixed"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace throng
