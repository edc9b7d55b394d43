// SPDX-License-Identifier: MIT
#include "sim/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "sim/step.h"
#include "tests/sim/scene_from.h"

namespace throng {
namespace {

const char* const kTwoDiscs =
    "[shapes]\nball = { disc = { radius = 0.5 } }\n"
    "[[bodies]]\nshape = \"ball\"\nat = [0, 0]\n[[bodies]]\nshape = \"ball\"\nat = [3, 0]\n";

bool runs(const Plan& plan, const std::string& name) {
  for (const Stage& stage : plan.stages)
    if (stage.name == name) return stage.runs;
  ADD_FAILURE() << "no stage " << name;
  return false;
}

TEST(Plan, SkipsWhatTheSceneDoesNotHave) {
  const Plan plan = plan_for(scene_from(std::string("[materials.default]\nfriction = 0\n") + kTwoDiscs));
  for (const char* name : {"gravity", "obstacles", "box", "friction", "wrap"})
    EXPECT_FALSE(runs(plan, name)) << name;
  for (const char* name : {"find_pairs", "find_contacts", "integrate", "collide", "solve"})
    EXPECT_TRUE(runs(plan, name)) << name;
  EXPECT_FALSE(plan.polygons);
}

TEST(Plan, RunsWhatTheSceneHas) {
  const Plan plan = plan_for(scene_from(std::string("gravity = [0, -9.81]\ndomain = { box = [[-5, -5], [5, "
                                                    "5]] }\n[materials.default]\nrestitution = 0.5\n") +
                                        kTwoDiscs + "[[walls]]\nsegment = [[-1, -2], [1, -2]]\n"));
  for (const char* name : {"gravity", "obstacles", "box", "collide", "friction"})
    EXPECT_TRUE(runs(plan, name)) << name;
}

TEST(Plan, SaysThatWhatHitsIsStopped) {
  for (const bool bounces : {false, true}) {
    const Plan plan = plan_for(scene_from(
        "[materials.default]\nrestitution = " + std::string(bounces ? "0.5\n" : "0\n") + kTwoDiscs));
    EXPECT_EQ(std::ranges::find(plan.stages, "collide", &Stage::name)->reason,
              bounces
                  ? "surfaces that meet bounce"
                  : "who meets is stopped, together with all that touches him: no surfaces that meet bounce");
  }
}

/// After fifty steps of discs that fall, or fly, into each other and onto a floor.
std::uint64_t hash_of(const Scene& scene, const Plan& plan) {
  State state = initial_state(scene);
  Workspace work(scene, plan, 1);
  for (int i = 0; i < 50; ++i) step(scene, plan, state, work);
  return hash(state);
}

std::string crowded_discs(const std::string& settings) {
  return "seed = 3\ntime = { dt = 0.01, until = 1, substeps = 2 }\nsleep = false\n" + settings +
         "\n[shapes]\nball.disc.radius = 0.5\n[[bodies]]\nshape = 'ball'\nvelocity = { maxwell = 2 }\n"
         "place.lattice = { origin = [0, 0], spacing = [1.01, 1.02], size = [9, 9] }\n"
         "[[walls]]\nsegment = [[-20, -0.5], [30, -0.5]]\n";
}

TEST(Plan, DiscsThatNothingTurnsCarryNoRotation) {
  for (const char* settings : {"gravity = [0, -9.81]\nmaterials.default.friction = 0",
                               "materials.default = { friction = 0, restitution = 1 }"}) {
    const Scene scene = scene_from(crowded_discs(settings));
    Plan plan = plan_for(scene);
    EXPECT_FALSE(runs(plan, "rotation")) << settings;
    const std::uint64_t without = hash_of(scene, plan);
    plan.rotation = plan.friction = true;
    EXPECT_EQ(hash_of(scene, plan), without) << settings;
  }
}

TEST(Plan, WhatTurnsOrMayBeTurnedDoes) {
  const std::string smooth = "materials.default.friction = 0\n", spinning = "spin = 1\n";
  const std::string square =
      "[shapes.square]\npolygon = [[9, 9], [10, 9], [10, 10], [9, 10]]\n"
      "[[bodies]]\nshape = 'square'\nat = [9, 9]\n";
  for (const auto& [text, turns] :
       {std::pair{smooth + kTwoDiscs, false},
        {smooth + kTwoDiscs + spinning, true},
        {kTwoDiscs, true},
        {smooth + kTwoDiscs + square, true},
        {"contact.model = 'none'\n" + square, false},
        {"materials.default = { friction = 0, rolling_resistance = 0.1 }\n" + std::string(kTwoDiscs), true}})
    EXPECT_EQ(runs(plan_for(scene_from(text)), "rotation"), turns) << text;
}

TEST(Plan, SensesAfterBodiesAreWrapped) {
  EXPECT_EQ(plan_for(scene_from(kTwoDiscs)).stages.back().name, "sense");
}

TEST(Plan, HasNoContactsWhereTheModelIsNone) {
  const Plan plan = plan_for(scene_from(std::string("contact = { model = \"none\" }\n") + kTwoDiscs));
  EXPECT_FALSE(plan.contacts());
  for (const char* name : {"find_pairs", "find_contacts", "solve"}) EXPECT_FALSE(runs(plan, name)) << name;
}

TEST(Plan, SaysWhatSoftContactsCost) {
  const Plan plan = plan_for(scene_from(std::string("gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = "
                                                    "100 }\ncontact = { model = \"spring\", stiffness = "
                                                    "1e5 }\nmaterials.default.restitution = 0.9\n") +
                                        kTwoDiscs));
  EXPECT_TRUE(plan.soft);
  EXPECT_FALSE(plan.sleep);
  for (const char* name : {"find_contacts", "collide", "sleep"}) EXPECT_FALSE(runs(plan, name)) << name;
  for (const Stage& stage : plan.stages)
    if (stage.name == "solve") {
      // pi sqrt(m / 2 / k), m = pi / 4 kg
      EXPECT_EQ(stage.reason, "linear springs and dashpots, 100 substeps: 62.3 in an impact of 0.00623 s");
    }
}

TEST(Plan, GivesAReasonForEachStage) {
  for (const Stage& stage : plan_for(scene_from(kTwoDiscs)).stages)
    EXPECT_FALSE(stage.reason.empty()) << stage.name;
}

TEST(Plan, PairsTakeTheGeometricMeanOfFrictionAndTheLargerRestitution) {
  const Scene scene = scene_from(std::string("[materials.default]\nfriction = 0.4\nrestitution = 0.1\n"
                                             "[materials.ice]\nfriction = 0.1\nrestitution = 0.7\n") +
                                 kTwoDiscs);
  const Plan plan = plan_for(scene);
  ASSERT_EQ(plan.surfaces.size(), 4u);
  EXPECT_DOUBLE_EQ(plan.surfaces[1].friction, 0.2);
  EXPECT_DOUBLE_EQ(plan.surfaces[1].restitution, 0.7);
  EXPECT_DOUBLE_EQ(plan.surfaces[2].friction, 0.2);
}

/// It happened: friction ran where the default material alone rubs, of which nobody was.
TEST(Plan, LooksAtSurfacesThatMayMeetAlone) {
  const std::string smooth =
      "[materials.default]\nfriction = 0.5\nrestitution = 0.4\nrolling_resistance = 0.1\n"
      "[materials.ice]\nfriction = 0\n"
      "[materials.rubber]\nfriction = 0.5\nrestitution = 0.4\nrolling_resistance = 0.1\n"
      "[shapes]\nball = { disc = { radius = 0.5 } }\n"
      "[[bodies]]\nshape = 'ball'\nmaterial = 'ice'\nat = [0, 0]\n"
      "[[bodies]]\nshape = 'ball'\nmaterial = 'ice'\nat = [3, 0]\n";
  const std::string ice_floor = "[[walls]]\nsegment = [[-9, -5], [9, -5]]\nmaterial = 'ice'\n";
  const std::string mill =
      "[[bodies]]\nshape = 'ball'\nmaterial = 'rubber'\nat = [0, 8]\nkind = 'kinematic'\n";
  const auto bounces = [](const std::string& text) { return plan_for(scene_from(text)).restitution; };
  const auto rolls = [](const std::string& text) { return plan_for(scene_from(text)).rolling; };
  for (const std::string& text : {smooth, smooth + ice_floor}) {
    EXPECT_FALSE(runs(plan_for(scene_from(text)), "friction")) << text;
    EXPECT_FALSE(bounces(text) || rolls(text)) << text;
  }
  const std::string box = "domain.box = [[-9, -9], [9, 9]]\n";
  EXPECT_TRUE(bounces(box + smooth) && rolls(box + smooth)) << "its walls are of the default";
  EXPECT_FALSE(runs(plan_for(scene_from(box + smooth)), "friction")) << "ice is smooth to all";
  EXPECT_TRUE(bounces(smooth + mill) && rolls(smooth + mill)) << "ice meets it";
  EXPECT_FALSE(runs(plan_for(scene_from(smooth + mill)), "friction")) << "rubber doesn't meet rubber";
  EXPECT_TRUE(runs(
      plan_for(scene_from(smooth + mill + "[[bodies]]\nshape = 'ball'\nmaterial = 'rubber'\nat = [5, 8]\n")),
      "friction"));
}

TEST(Plan, LetsBodiesSleepWhereSomethingPullsThemOntoSomething) {
  const std::string pulls = "gravity = [0, -9.81]\n";
  EXPECT_TRUE(runs(plan_for(scene_from(pulls + kTwoDiscs)), "sleep"));
  const std::string agents =
      "domain.box = [[0, 0], [9, 9]]\n[areas]\na = [[0, 0], [9, 0], [9, 9], [0, 9]]\n[[agents]]\ncount = "
      "1\nmodel = 'orca'\ngoal = 'a'\n"
      "place.random.within = 'a'\n";
  const std::pair<std::string, std::string> never[] = {
      {pulls + "sleep = false\n" + kTwoDiscs, "sleep is false"},
      {kTwoDiscs, "gravity is zero: what is slow isn't at rest"},
      {pulls + "contact = { model = \"none\" }\n" + kTwoDiscs, "nothing to rest on"}};
  for (const auto& [text, reason] : never) {
    const Plan plan = plan_for(scene_from(text));
    EXPECT_FALSE(plan.sleep) << text;
    EXPECT_EQ(std::ranges::find(plan.stages, "sleep", &Stage::name)->reason, reason);
    EXPECT_TRUE(initial_state(scene_from(text)).sleep.island.empty());
  }
  EXPECT_FALSE(plan_for(scene_from(pulls + agents)).sleep);
}

/// It happened: the native engine was said to skip "sleep", as the matter of Box2D.
TEST(Plan, SaysOfOtherEnginesWhatTheNativeOneWouldRun) {
  const std::string pulls = std::string("gravity = [0, -9.81]\n") + kTwoDiscs;
  const Scene scene = scene_from("engine = \"box2d\"\n" + pulls);
  const Plan native = plan_for(scene_from(pulls)), other = plan_for(scene);
  EXPECT_FALSE(other.sleep);
  EXPECT_TRUE(initial_state(scene).sleep.island.empty());
  for (std::size_t i = 0; i < native.stages.size(); ++i) {
    EXPECT_EQ(other.stages[i].runs, native.stages[i].runs) << native.stages[i].name;
    EXPECT_EQ(other.stages[i].reason, native.stages[i].reason);
  }
}

TEST(Plan, AStageThatIsSkippedAllocatesNothing) {
  const Scene scene = scene_from(std::string("contact = { model = \"none\" }\n") + kTwoDiscs);
  const Plan plan = plan_for(scene);
  State state = initial_state(scene);
  Workspace work(scene, plan, 1);
  for (int i = 0; i < 10; ++i) step(scene, plan, state, work);
  EXPECT_FALSE(work.guard);
  EXPECT_EQ(work.contacts.disc_key.capacity(), 0u);
  EXPECT_EQ(work.contacts.point_key.capacity(), 0u);
  EXPECT_EQ(work.candidates.pairs().size(), 0u);
  EXPECT_EQ(work.candidates.obstacles().size(), 0u);
  EXPECT_EQ(state.disc_contacts.capacity(), 0u);
}

TEST(Plan, ResistsRollingOnlyWhereADiscIs) {
  const std::string resisting =
      "[materials.default]\nrolling_resistance = 0.1\n[[walls]]\nsegment = [[0, 0], [9, 0]]\n";
  for (const auto& [shape, rolls] : {std::pair{"disc.radius = 1", true},
                                     {"discs = [[0, 0, 1], [1, 0, 1]]", true},
                                     {"polygon = [[0, 0], [1, 0], [1, 1]]", false}}) {
    const Plan plan = plan_for(
        scene_from(resisting + "[shapes]\ns." + shape + "\n[[bodies]]\nshape = \"s\"\nat = [2, 2]\n"));
    EXPECT_EQ(plan.rolling, rolls) << shape;
  }
}

}  // namespace
}  // namespace throng
