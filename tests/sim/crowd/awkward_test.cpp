// SPDX-License-Identifier: MIT
// Awkward crowds: a clear error, or a behaviour that is defined.
#include <gtest/gtest.h>

#include "sim/crowd/stuck.h"
#include "sim/crowd/walk.h"
#include "sim/input_error.h"
#include "sim/simulation.h"
#include "tests/sim/crowd/models.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

std::string floor(const std::string& walkable, const std::string& agents) {
  return "time = { dt = 0.01, until = 100 }\nseed = 2\nwalkable = '" + walkable +
         "'\n[areas]\nleft = [[0, 0], [1, 0], [1, 4], [0, 4]]\nright = [[19, 0], [20, 0], [20, 4], [19, "
         "4]]\n" +
         agents;
}

std::string agent(const std::string& model, const std::string& at, const std::string& goal) {
  return "[[agents]]\nmodel = '" + model + "'\nat = " + at + "\ngoal = '" + goal + "'\n";
}

const std::string kCorridor = "POLYGON ((0 0, 20 0, 20 4, 0 4, 0 0))";

std::string refusal_of(const Scene& scene) {
  try {
    simulation(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string scene_refusal(const std::string& text) {
  return refusal_of(scene_from(text));
}

TEST(AwkwardCrowd, TwoWhoMeetHeadOnPass) {
  for (const char* model : {"social_force", "collision_free_speed", "orca"}) {
    SCOPED_TRACE(model);
    Trial run(floor(kCorridor, agent(model, "[2, 2]", "right") + agent(model, "[18, 2]", "left")));
    run.steps(4000);
    EXPECT_EQ(run.state.crowd.arrived, 2);
    Trial again(run.scene);
    Trial three(run.scene, 3);
    again.steps(1000), three.steps(1000);
    EXPECT_EQ(hash(again.state), hash(three.state)) << "at random, and the same again";
  }
}

TEST(AwkwardCrowd, FourWhoCrossInOnePointPass) {
  for (const char* model : {"social_force", "collision_free_speed", "orca"}) {
    SCOPED_TRACE(model);
    Trial run(
        "time = { dt = 0.01, until = 100 }\nwalkable = 'POLYGON ((0 0, 20 0, 20 20, 0 20, 0 0))'\n"
        "[areas]\nl = [[0, 8], [1, 8], [1, 12], [0, 12]]\nr = [[19, 8], [20, 8], [20, 12], [19, 12]]\n"
        "b = [[8, 0], [12, 0], [12, 1], [8, 1]]\nt = [[8, 19], [12, 19], [12, 20], [8, 20]]\n" +
        agent(model, "[2, 10]", "r") + agent(model, "[18, 10]", "l") + agent(model, "[10, 2]", "t") +
        agent(model, "[10, 18]", "b"));
    run.steps(6000);
    EXPECT_EQ(run.state.crowd.arrived, 4);
  }
}

// It happened: of this crowd fifteen got out, then three held one another before the door for ever.
TEST(AwkwardCrowd, AnArchBeforeADoorDoesNotStandForEver) {
  Trial run(
      "time = { dt = 0.01, until = 100 }\nseed = 5\n"
      "walkable = 'POLYGON ((0 0, 15 0, 15 7, 15.2 7, 15.2 0, 20 0, 20 15, 15.2 15, 15.2 8, 15 8, 15 15, 0 "
      "15, 0 0))'\n"
      "[areas]\nroom = [[0, 0], [15, 0], [15, 15], [0, 15]]\nbeyond = [[18, 0], [20, 0], [20, 15], [18, "
      "15]]\n"
      "[[agents]]\nmodel = 'collision_free_speed'\ncount = 200\nplace.random.within = 'room'\n"
      "radius.uniform = [0.25, 0.35]\ndesired_speed = 1.5\ngoal = 'beyond'\n");
  run.steps(4000);
  const std::int64_t before = run.state.crowd.arrived;
  run.steps(8000);
  EXPECT_GT(run.state.crowd.arrived, before + 20);
}

TEST(AwkwardCrowd, TwoInOnePlacePartOrWalkTogether) {
  for (const char* model : kModels) {
    SCOPED_TRACE(model);
    Trial run(floor(kCorridor, agent(model, "[5, 2]", "right") + agent(model, "[5, 2]", "right")));
    run.steps(500);
    const double apart = (run.state.position[0] - run.state.position[1]).norm();
    if (model == std::string("constant_velocity"))
      EXPECT_EQ(apart, 0.0) << "m: nobody is seen";
    else
      EXPECT_GT(apart, 0.35) << "m";
    run.steps(2500);
    EXPECT_EQ(run.state.crowd.arrived, 2);
  }
}

TEST(AwkwardCrowd, WhoWantsNoSpeedStands) {
  for (const char* model : kModels) {
    SCOPED_TRACE(model);
    Trial run(floor(kCorridor, agent(model, "[5, 2]", "right") + "desired_speed = 0\n"));
    run.steps(2000);
    ASSERT_EQ(run.state.id.size(), 1u);
    EXPECT_EQ(run.state.position[0], Vec(5, 2));
    EXPECT_TRUE(stuck_agents(run.scene, run.state).empty());
  }
}

TEST(AwkwardCrowd, AGoalUnderABodyIsAnError) {
  const Loaded loaded =
      load_scenario_text("throng = 1\n" + floor(kCorridor, agent("orca", "[5, 2]", "right")) +
                             "[shapes]\nblock.polygon = [[0, 0], [3, 0], [3, 6], [0, 6]]\n"
                             "[[bodies]]\nshape = 'block'\nkind = 'static'\nat = [19.5, 2]\n",
                         "s");
  EXPECT_NE(to_string(loaded.diagnostics, "s").find("areas.right: has nothing in common with the walkable"),
            std::string::npos);
}

TEST(AwkwardCrowd, AGoalOffTheFloorOfASceneThatNoFileMadeIsAnError) {
  Scene scene = scene_from(floor(kCorridor, agent("orca", "[5, 2]", "right")));
  for (std::vector<Vec>& ring : scene.crowd.goals.at(0).region.rings)
    for (Vec& point : ring) point.x() += 10.0;
  EXPECT_EQ(refusal_of(scene),
            "agents[0]: its goal \"right\" is nowhere on the floor that agent 1 of 1 (id 1, radius 0.2 m), "
            "or any other as wide, gets to");
}

TEST(AwkwardCrowd, FloorsInPiecesLeadOnlyWithinAPiece) {
  const std::string pieces = "MULTIPOLYGON (((0 0, 8 0, 8 4, 0 4, 0 0)), ((10 0, 20 0, 20 4, 10 4, 10 0)))";
  EXPECT_NE(scene_refusal(floor(pieces, agent("orca", "[5, 2]", "right"))).find("no way wide enough"),
            std::string::npos);
  EXPECT_EQ(scene_refusal(floor(pieces, agent("orca", "[5, 2]", "left"))), "accepted");
  EXPECT_EQ(scene_refusal(floor(pieces, agent("orca", "[12, 2]", "right"))), "accepted");
}

TEST(AwkwardCrowd, NobodyGetsThroughAPoint) {
  const std::string touching = "MULTIPOLYGON (((0 0, 10 2, 0 4, 0 0)), ((10 2, 20 0, 20 4, 10 2)))";
  EXPECT_NE(scene_refusal(floor(touching, agent("orca", "[2, 2]", "right"))).find("no way wide enough"),
            std::string::npos);
  // holes that touch each other and the floor's edges in points: two floors, which must be said to be two
  const std::string holes =
      "POLYGON ((0 0, 20 0, 20 4, 0 4, 0 0), (10 0, 11 1, 10 2, 9 1, 10 0), (10 2, 11 3, 10 4, 9 3, 10 2))";
  const Loaded loaded =
      load_scenario_text("throng = 1\n" + floor(holes, agent("orca", "[2, 2]", "right")), "s");
  EXPECT_NE(to_string(loaded.diagnostics, "s").find("walkable: is no polygon: Interior is disconnected"),
            std::string::npos);
}

TEST(AwkwardCrowd, NobodyGetsThroughACorridorNarrowerThanHimself) {
  const auto corridor = [](const std::string& low, const std::string& high) {
    return "POLYGON ((0 0, 8 0, 8 " + low + ", 12 " + low + ", 12 0, 20 0, 20 4, 12 4, 12 " + high + ", 8 " +
           high + ", 8 4, 0 4, 0 0))";
  };
  const std::string wide = floor(corridor("1.79", "2.21"), agent("orca", "[2, 2]", "right"));
  EXPECT_EQ(scene_refusal(wide), "accepted") << "0.42 m for 0.4 m";
  Trial run(wide);
  run.steps(3000);
  EXPECT_EQ(run.state.crowd.arrived, 1);
  EXPECT_NE(
      scene_refusal(floor(corridor("1.81", "2.19"), agent("orca", "[2, 2]", "right"))).find("no way wide"),
      std::string::npos);
}

TEST(AwkwardCrowd, EntrancesAndPlacesToWaitThatAreTooSmallAreAnError) {
  const std::string small = "small = [[4, 1], [4.3, 1], [4.3, 1.3], [4, 1.3]]\n";
  const Loaded entrance = load_scenario_text(
      "throng = 1\n" + floor(kCorridor, small + "[[agents]]\nmodel = 'orca'\ngoal = 'right'\ncount = 3\n"
                                                "appear.rate = 1\nplace.random.within = 'small'\n"),
      "s");
  EXPECT_EQ(entrance.errors(), 1);
  Trial waits(floor(kCorridor, small + "[[agents]]\nmodel = 'orca'\nat = [2, 2]\n"
                                       "goal = [{ wait = 'small', for = 5 }, 'right']\n"));
  waits.steps(3000);
  EXPECT_EQ(waits.state.crowd.arrived, 1) << "stood where it got to";
}

}  // namespace
}  // namespace throng
