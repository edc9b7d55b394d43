// SPDX-License-Identifier: MIT
#include "sim/plan.h"

#include <gtest/gtest.h>

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
  for (const char* name : {"gravity", "obstacles", "box", "collide", "friction", "wrap"})
    EXPECT_FALSE(runs(plan, name)) << name;
  for (const char* name : {"find_pairs", "find_contacts", "integrate", "solve"})
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

TEST(Plan, SensesAfterBodiesAreWrapped) {
  EXPECT_EQ(plan_for(scene_from(kTwoDiscs)).stages.back().name, "sense");
}

TEST(Plan, HasNoContactsWhereTheModelIsNone) {
  const Plan plan = plan_for(scene_from(std::string("contact = { model = \"none\" }\n") + kTwoDiscs));
  EXPECT_FALSE(plan.contacts());
  for (const char* name : {"find_pairs", "find_contacts", "solve"}) EXPECT_FALSE(runs(plan, name)) << name;
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

TEST(Plan, AStageThatIsSkippedAllocatesNothing) {
  const Scene scene = scene_from(std::string("contact = { model = \"none\" }\n") + kTwoDiscs);
  const Plan plan = plan_for(scene);
  State state = initial_state(scene);
  Workspace work(scene, plan, 1);
  for (int i = 0; i < 10; ++i) step(scene, plan, state, work);
  EXPECT_EQ(work.contacts.disc_key.capacity(), 0u);
  EXPECT_EQ(work.contacts.point_key.capacity(), 0u);
  EXPECT_EQ(work.candidates.pairs().size(), 0u);
  EXPECT_EQ(work.candidates.obstacles().size(), 0u);
  EXPECT_EQ(state.disc_contacts.capacity(), 0u);
}

}  // namespace
}  // namespace throng
