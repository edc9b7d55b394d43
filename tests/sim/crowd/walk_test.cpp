// SPDX-License-Identifier: MIT
// Whole crowds: what the step must do with them, whatever their model.
#include "sim/crowd/walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "sim/crowd/row_order.h"
#include "sim/crowd/stuck.h"
#include "sim/input_error.h"
#include "sim/recording/checkpoint.h"
#include "sim/simulation.h"
#include "tests/sim/crowd/models.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// A corridor 2 m wide and 42 m long, whose last 2 m are the goal.
std::string corridor(const std::string& model, const std::string& agents) {
  return "time = { dt = 0.02, until = 100 }\nwalkable = 'POLYGON ((0 0, 42 0, 42 2, 0 2, 0 0))'\n"
         "areas.exit = [[40, 0], [42, 0], [42, 2], [40, 2]]\nareas.start = [[0, 0], [12, 0], [12, 2], [0, "
         "2]]\n"
         "[[agents]]\ngoal = 'exit'\nmodel = '" +
         model + "'\n" + agents;
}

/// Rooms with a pillar and a narrow door, crowded.
std::string rooms(const std::string& model) {
  return "time = { dt = 0.02, until = 100 }\nseed = 3\n"
         "walkable = 'POLYGON ((0 0, 6 0, 6 2.5, 6.2 2.5, 6.2 0, 12 0, 12 6, 6.2 6, 6.2 3.5, 6 3.5, 6 6, 0 "
         "6, 0 0), "
         "(4 2, 5 2, 5 4, 4 4, 4 2))'\n"
         "areas.exit = [[11, 0], [12, 0], [12, 6], [11, 6]]\nareas.start = [[0, 0], [4, 0], [4, 6], [0, 6]]\n"
         "[[agents]]\ngoal = 'exit'\ncount = 60\nplace = { random = { within = 'start' } }\n"
         "desired_speed = { normal = [2, 0.5] }\nradius = { uniform = [0.15, 0.25] }\nmodel = '" +
         model + "'\n";
}

TEST(Walk, TakesFortySecondsForFortyMetresAtOneMetreASecond) {  // IMO MSC.1/Circ.1533, test 1
  for (const char* model : kModels) {
    SCOPED_TRACE(model);
    Trial run(corridor(model, "at = [0.5, 1]\ndesired_speed = 1\n"));
    run.steps(2200);
    EXPECT_EQ(run.state.id.size(), 0u);
    EXPECT_EQ(run.state.crowd.arrived, 1);
    EXPECT_NEAR(run.state.crowd.arrivals.back() * 0.02, 39.5,
                std::string(model) == "social_force" ? 0.6 : 0.05);
    EXPECT_EQ(run.state.crowd.wall_corrections, 0);
  }
}

TEST(Walk, RemovesWhoArrivesAndKeepsTheNamesOfTheOthers) {
  Trial run(corridor("constant_velocity",
                     "at = [30, 1]\n[[agents]]\nmodel = 'constant_velocity'\ngoal = 'exit'\nat = [39.9, 1]\n"
                     "[[agents]]\nmodel = 'constant_velocity'\ngoal = 'exit'\nat = [20, 1]\n"));
  run.steps(20);
  EXPECT_EQ(run.state.id, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_NEAR(run.state.position[1].x(), 20 + 20 * 0.02 * 1.34, 1e-3);
  EXPECT_EQ(run.state.crowd.arrived, 1);
  EXPECT_EQ(run.state.crowd.stand.size(), 2u);
}

/// With a group for each agent, that has the agent's parameters.
Scene parted(Scene scene) {
  Crowd& crowd = scene.crowd;
  std::vector<AgentGroup> groups;
  for (const AgentGroup& group : crowd.groups)
    for (std::uint32_t agent = 0; agent < group.count; ++agent) {
      const auto parameters = group.parameters_of(agent);
      groups.push_back(group);
      groups.back().own = false, groups.back().first = group.first + agent, groups.back().count = 1;
      groups.back().parameters.assign(parameters.begin(), parameters.end());
      crowd.group[group.first + agent] = static_cast<std::uint32_t>(groups.size() - 1);
    }
  crowd.groups = std::move(groups);
  return scene;
}

TEST(Walk, GivesEachAgentTheParametersThatWereDrawnForIt) {
  for (const auto& [model, parameters] :
       {std::pair("social_force", "{ reaction_time = { uniform = [0.3, 0.8] } }"),
        std::pair("collision_free_speed", "{ time_gap = { normal = [1, 0.3], within = [0.5, 1.5] } }"),
        std::pair("orca", "{ horizon = { lognormal = [3, 1], within = [1, 6] } }")}) {
    SCOPED_TRACE(model);
    const std::string all = rooms(model), more = std::string(model) + " = " + parameters + "\n";
    const std::string others =
        "[[agents]]\ngoal = 'exit'\ncount = 10\nplace = { random = { within = 'start' } }\nmodel = '" +
        std::string(model) + "'\n";
    Trial own(all + more + others), threaded(own.scene, 2), each(parted(own.scene)), alike(all + others);
    for (Trial* run : {&own, &threaded, &each, &alike}) run->steps(300);
    EXPECT_EQ(own.state.position, each.state.position);
    EXPECT_EQ(own.state.position, threaded.state.position);
    EXPECT_NE(own.state.position, alike.state.position);
  }
}

TEST(Walk, GivesNobodyWhatWasDrawnForAnother) {
  const std::string at = "[[agents]]\ngoal = 'exit'\nmodel = ";
  const std::string one = at + "'social_force'\nat = [1, 1]\n";
  const std::string others =
      at + "'collision_free_speed'\nat = [3, 1]\n" + at + "'social_force'\nat = [3, 5]\n";
  Trial drawn(rooms("orca") + one + "social_force.mass = { uniform = [80, 80] }\n" + others);
  Trial fixed(rooms("orca") + one + others);
  drawn.steps(100), fixed.steps(100);
  EXPECT_EQ(drawn.state.position, fixed.state.position);
}

TEST(Walk, AsksAgentsOfManyModelsAsThoseWithTheirOwn) {
  std::string scene = rooms("orca");
  for (int i = 0; i < 40; ++i)
    scene +=
        "[[agents]]\ngoal = 'exit'\nplace.random.within = 'start'\nmodel = 'social_force'\nradius = 0.1\n"
        "social_force.mass = " +
        std::to_string(80 + i) + "\n";
  Trial many(scene);
  EXPECT_EQ(mass(many.scene, 99), 119.0) << "kg, of the last one";
  Scene own = many.scene;
  auto& groups = own.crowd.groups;
  groups[1].own = true, groups[1].count = 40;
  for (std::size_t i = 2; i < 41; ++i)
    groups[1].parameters.insert(groups[1].parameters.end(), groups[i].parameters.begin(),
                                groups[i].parameters.end());
  groups.resize(2);
  for (std::uint32_t& group : own.crowd.group) group = std::min(group, 1u);
  Trial merged(own);
  many.steps(50), merged.steps(50);
  EXPECT_EQ(many.state.position, merged.state.position);
}

TEST(Walk, NobodyPassesAWall) {
  std::int64_t corrections = 0;
  for (const char* model : kModels) {
    SCOPED_TRACE(model);
    Trial run(rooms(model));
    const Barriers barriers(barrier_lines(run.scene), 1.0);
    for (int i = 0; i < 1500; ++i) {
      run.steps(1);
      for (std::size_t row = 0; row < run.state.id.size(); ++row) {
        const Vec& p = run.state.position[row];
        ASSERT_TRUE(contains(run.scene.crowd.walkable, p)) << "step " << i << " agent " << run.state.id[row];
        const double radius = run.scene.bodies.radius[run.state.id[row] - 1];
        const double core = model == std::string("social_force") ? 0.5 * radius : radius;
        ASSERT_GE(barriers.distance(p, core), core * (1 - 1e-9))
            << "step " << i << " agent " << run.state.id[row];
      }
    }
    EXPECT_GT(run.state.crowd.arrived, 20);
    corrections += run.state.crowd.wall_corrections;
  }
  EXPECT_GT(corrections, 0) << "else no wall was in anybody's way";
}

TEST(Walk, EveryoneGetsThroughARoomWithAPillarAndADoor) {
  Trial run(rooms("social_force"));
  run.steps(5000);
  EXPECT_EQ(run.state.crowd.arrived, 60);
}

TEST(Walk, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const char* model : kModels) {
    Scene scene = scene_from(
        "time = { dt = 0.02, until = 100 }\ndomain.box = [[0, 0], [60, 60]]\n"
        "areas.exit = [[58, 20], [60, 20], [60, 40], [58, 40]]\nareas.middle = [[30, 25], [34, 25], [34, "
        "35], [30, 35]]\n"
        "areas.door = [[0, 0], [4, 0], [4, 4], [0, 4]]\n[[walls]]\npolyline = [[20, 5], [20, 40], [45, 40], "
        "[45, 30]]\n"
        "[[measure]]\nname = 'middle'\narea = 'middle'\n[[measure]]\nname = 'line'\nline = [[50, 0], [50, "
        "60]]\n"
        "[[agents]]\ngoal = 'exit'\ncount = 1500\nplace.random.within = [[5, 0], [58, 60]]\nmodel = '" +
        std::string(model) +
        "'\n[[agents]]\ngoal = ['middle', 'exit']\ncount = 20\nappear.rate = 20\n"
        "place.random.within = 'door'\nmodel = '" +
        model + "'\n");
    Trial one(scene), three(scene, 3);
    one.steps(100), three.steps(100);
    ASSERT_GT(one.state.id.size(), 1024u) << "fewer are no work for several threads";
    EXPECT_EQ(hash(one.state), hash(three.state)) << model;
    EXPECT_EQ(one.state.crowd.wall_corrections, three.state.crowd.wall_corrections);
    EXPECT_EQ(one.state.crowd.measured, three.state.crowd.measured);
    EXPECT_EQ(one.state.crowd.stage, three.state.crowd.stage);
    EXPECT_GT(one.state.crowd.arrived, 10);
    EXPECT_GT(one.state.crowd.measured[0].count + one.state.crowd.measured[1].count, 20);
  }
}

TEST(Walk, GoesOnFromAStateWithTheBitsOfTheRunItself) {
  const Scene scene = scene_from(rooms("collision_free_speed"));
  const auto whole = simulation(scene), first = simulation(scene), second = simulation(scene);
  for (int i = 0; i < 600; ++i) whole->step();
  for (int i = 0; i < 400; ++i) first->step();
  ASSERT_GT(first->state().crowd.arrived, 0);
  ASSERT_TRUE(second->restore(first->state()));
  for (int i = 0; i < 200; ++i) second->step();
  EXPECT_EQ(hash(whole->state()), hash(second->state()));
  EXPECT_EQ(whole->state().crowd.arrived, second->state().crowd.arrived);
}

TEST(Walk, RemembersWhoArrivedByStepAndThenById) {
  Trial run(
      corridor("constant_velocity",
               "count = 4200\nradius = 0.02\nplace = { random = { within = [[28, 0], [39.9, 2]] } }\n"));
  ASSERT_TRUE(rows_follow(run.scene.crowd));  // so that rows aren't in the order of ids
  const std::vector<std::uint32_t> all = run.state.id;
  run.steps(150);
  const CrowdState& crowd = run.state.crowd;
  ASSERT_GT(crowd.arrived, 500);
  std::vector<std::pair<std::int64_t, std::uint32_t>> who;
  for (std::size_t i = 0; i < crowd.arrivals.size(); ++i)
    who.emplace_back(crowd.arrivals[i], crowd.arrived_id[i]);
  EXPECT_TRUE(std::ranges::is_sorted(who));
  std::vector<std::uint32_t> ids = run.state.id;
  ids.insert(ids.end(), crowd.arrived_id.begin(), crowd.arrived_id.end());
  std::ranges::sort(ids);
  EXPECT_EQ(ids, all);
}

TEST(Walk, ACheckpointKeepsAllOfACrowd) {
  Trial run(rooms("collision_free_speed") + "[[measure]]\nname = 'door'\nline = [[6, 2.5], [6, 3.5]]\n");
  run.steps(500);
  ASSERT_GT(run.state.crowd.arrived, 0);
  ASSERT_GT(run.state.crowd.measured.at(0).count, 0);
  for (int i = 0; i < 500 && run.state.crowd.on_line.empty(); ++i) run.steps(1);
  const std::string file = ::testing::TempDir() + "crowd.ckpt";
  recording::write_checkpoint(file, {"1", "", 0, 0}, run.state);
  const State read = recording::read_checkpoint(file).state;
  EXPECT_EQ(hash(read), hash(run.state));
  EXPECT_EQ(read.crowd.stand, run.state.crowd.stand);
  EXPECT_EQ(read.crowd.stand_step, run.state.crowd.stand_step);
  EXPECT_EQ(read.crowd.arrived, run.state.crowd.arrived);
  EXPECT_EQ(std::ssize(run.state.crowd.arrivals), run.state.crowd.arrived);
  EXPECT_EQ(read.crowd.arrivals, run.state.crowd.arrivals);
  EXPECT_EQ(read.crowd.arrived_id, run.state.crowd.arrived_id);
  EXPECT_EQ(read.crowd.wall_corrections, run.state.crowd.wall_corrections);
  EXPECT_EQ(read.crowd.measured, run.state.crowd.measured);
  EXPECT_FALSE(run.state.crowd.on_line.empty());
  EXPECT_EQ(read.crowd.on_line, run.state.crowd.on_line);
  EXPECT_TRUE(fits(read, run.scene));
  std::remove(file.c_str());
}

TEST(Walk, SaysBeforeTheRunWhomNoWayLeadsToHisGoal) {
  const Scene closed =
      scene_from(corridor("social_force", "at = [3, 1]\n[[walls]]\nsegment = [[20, 0], [20, 2]]\n"));
  try {
    simulation(closed);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "agents[0]: no way wide enough leads from [3, 1], where agent 1 of 1 (id 1, radius 0.2 m) stands, to "
        "its goal \"exit\"");
  }
  const std::string door =
      "[[walls]]\nsegment = [[20, 0], [20, 0.8]]\n[[walls]]\nsegment = [[20, 1.19], [20, 2]]\n";
  EXPECT_THROW(simulation(scene_from(corridor("social_force", "at = [3, 1]\nradius = 0.2\n" + door))),
               InputError);
  EXPECT_NO_THROW(simulation(scene_from(corridor("social_force", "at = [3, 1]\nradius = 0.19\n" + door))));
}

TEST(Walk, ListsWhoIsStuckBehindOneWhoWantsToStand) {
  Trial run(
      corridor("collision_free_speed",
               "at = [3, 1]\n[[agents]]\ngoal = 'exit'\nmodel = 'constant_velocity'\nat = [4, 1]\n"
               "desired_speed = 0\n[[agents]]\ngoal = 'exit'\nmodel = 'constant_velocity'\nat = [8, 1]\n"
               "[[walls]]\nsegment = [[0, 0.75], [7, 0.75]]\n[[walls]]\nsegment = [[0, 1.25], [7, 1.25]]\n"));
  run.steps(499);
  EXPECT_TRUE(stuck_agents(run.scene, run.state).empty()) << "nobody before 10 s";
  EXPECT_NEAR(run.state.position[0].x(), 3.6 - 0.1 * std::log(8.0), 1e-3)
      << "where turning away outweighs its way";
  run.steps(1000);
  const std::vector<StuckAgent> stuck = stuck_agents(run.scene, run.state);
  ASSERT_EQ(stuck.size(), 1u) << "2 wants nothing, 3 walks";
  EXPECT_EQ(stuck[0].id, 1u);
  EXPECT_EQ(stuck[0].position, run.state.position[0]);
}

// It happened: who wants less than a radius a second was in doubt, and less than a radius in 10 s stuck,
// though nothing was in his way: half as fast as he wanted, and not straight on.
TEST(Walk, LetsSlowAgentsWalkAsTheyWant) {
  for (const char* model : {"collision_free_speed", "constant_velocity", "social_force", "orca"})
    for (const double speed : {0.1, 0.015, 0.005}) {
      SCOPED_TRACE(model);
      Trial run(corridor(model, "at = [3, 1]\ndesired_speed = " + std::to_string(speed) + "\n"));
      for (int i = 0; i < 60; ++i) {
        run.steps(100);
        ASSERT_TRUE(stuck_agents(run.scene, run.state).empty()) << speed << " after " << run.state.step;
      }
      EXPECT_NEAR(run.state.position[0].x() - 3.0, speed * 120, 0.03 * speed * 120);
      EXPECT_NEAR(run.state.position[0].y(), 1.0, 1e-5 * speed * 120) << speed;
    }
}

// It happened: who is stuck goes aside for a second and comes back, which was taken for getting on: of thirty
// runs of up to 600 s before a door too narrow for the force of its jambs eight said that he was stuck.
TEST(Walk, ListsWhoIsStuckAtAnyTimeThoughHeGoesAside) {
  Trial run(
      "time = { dt = 0.01, until = 200 }\nwalkable = 'POLYGON ((0 0, 10 0, 10 6, 0 6, 0 0))'\n"
      "areas.exit = [[9, 2], [10, 2], [10, 4], [9, 4]]\n[[walls]]\nsegment = [[5, 0], [5, 2.7]]\n"
      "[[walls]]\nsegment = [[5, 3.3], [5, 6]]\n[[agents]]\nat = [1, 1.3]\nmodel = 'social_force'\n"
      "desired_speed = 1\ngoal = 'exit'\n");
  run.steps(2000);
  double way = 0.0;
  for (int i = 0; i < 180; ++i) {
    const Vec before = run.state.position[0];
    run.steps(100);
    way += (run.state.position[0] - before).norm();
    EXPECT_EQ(stuck_agents(run.scene, run.state).size(), 1u) << "after " << 21 + i << " s";
  }
  EXPECT_GT(way, 5.0) << "he went aside";
}

TEST(Walk, OverlapsAreMeasured) {
  const std::string two =
      "at = [5, 1]\n[[agents]]\ngoal = 'exit'\nmodel = 'constant_velocity'\nat = [5.3, 1]\n";
  const Scene scene = scene_from(corridor("constant_velocity", two));
  State state = initial_state(scene);
  EXPECT_EQ(overlap(scene, state).pairs, 1u);
  EXPECT_NEAR(overlap(scene, state).max, 0.1, 1e-12);
  state.position[0].y() = 0.05;
  EXPECT_EQ(overlap(scene, state).pairs, 1u) << "no longer each other, but the wall";
  EXPECT_NEAR(overlap(scene, state).max, 0.15, 1e-12);
}

TEST(Walk, PlanSaysThatThereIsACrowd) {
  EXPECT_TRUE(plan_for(scene_from(corridor("social_force", "at = [3, 1]\n"))).crowd);
  EXPECT_FALSE(plan_for(scene_from("gravity = [0, -9.81]\n")).crowd);
  const Plan pushed =
      plan_for(scene_from(corridor("orca",
                                   "at = [3, 1]\n[shapes]\nb.disc.radius = 0.5\n[[bodies]]\nshape = "
                                   "'b'\nkind = 'kinematic'\nat = [8, 1]\n")));
  for (const Stage& stage : pushed.stages) {
    EXPECT_FALSE(stage.name == "integrate" && stage.runs) << "he moves as they walk";
    EXPECT_TRUE(stage.name != "crowd" || stage.reason ==
                                             "1 agent looks, steers, walks and leaves at its goal, pushed by "
                                             "1 moving body")
        << stage.reason;
  }
}

TEST(WalkStages, ShowWhatMeasuringTakes) {
  const std::string crowd =
      "domain.box = [[0, 0], [9, 9]]\nareas.exit = [[8, 0], [9, 0], [9, 9], [8, 9]]\n"
      "[[agents]]\nmodel = 'orca'\nat = [1, 1]\ngoal = 'exit'\n";
  const auto names = [](const std::string& text) {
    const Scene scene = scene_from(text);
    std::vector<std::string> all;
    for (const auto& [name, time] : simulation(scene)->stage_times()) all.push_back(name);
    return all;
  };
  EXPECT_EQ(names(crowd), (std::vector<std::string>{"look", "steer", "walk", "leave"}));
  EXPECT_EQ(names(crowd + "[[measure]]\nname = 'exit'\narea = 'exit'\n"),
            (std::vector<std::string>{"look", "steer", "walk", "measure", "leave"}));
}

}  // namespace
}  // namespace throng
