// SPDX-License-Identifier: MIT
// Agents who appear in the course of time, set out late, and walk from goal to goal.
#include "sim/crowd/entrance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sim/crowd/stuck.h"
#include "sim/crowd/walk.h"
#include "sim/input_error.h"
#include "sim/recording/checkpoint.h"
#include "sim/simulation.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// A hall 20 m long with an entrance at its left end and exits in its two right corners.
std::string entrance_hall(const std::string& agents) {
  return "time = { dt = 0.02, until = 100 }\nseed = 5\nwalkable = 'POLYGON ((0 0, 20 0, 20 6, 0 6, 0 0))'\n"
         "[areas]\nstart = [[0, 2], [2, 2], [2, 4], [0, 4]]\nmiddle = [[9, 5], [11, 5], [11, 6], [9, 6]]\n"
         "low = [[19, 0], [20, 0], [20, 1], [19, 1]]\nhigh = [[19, 5], [20, 5], [20, 6], [19, 6]]\n"
         "[[agents]]\nmodel = 'collision_free_speed'\ndesired_speed = 1\nplace.random.within = 'start'\n" +
         agents;
}

TEST(Entrance, BringsAgentsInAtTheirRate) {
  Trial run(entrance_hall("goal = 'low'\ncount = 10\nappear = { rate = 2, from = 1 }\n"));
  EXPECT_EQ(run.state.id.size(), 0u);
  run.steps(49);
  EXPECT_EQ(run.state.id.size(), 0u) << "0.98 s";
  for (int half = 0; half < 10; ++half) {
    run.steps(half == 0 ? 1 : 25);
    EXPECT_EQ(run.state.id.size(), half + 1u) << run.state.step * 0.02 << " s";
    EXPECT_EQ(run.state.id.back(), half + 1u);
    EXPECT_EQ(waiting(run.state.crowd), 9u - half);
  }
  run.steps(1500);
  EXPECT_EQ(run.state.crowd.arrived, 10);
  EXPECT_TRUE(fits(run.state, run.scene));
}

TEST(Entrance, BringsGroupsInAtTheirTimes) {
  Trial run(entrance_hall("goal = 'low'\nappear = { times = [0, 0.5, 3], together = 3 }\n"));
  EXPECT_EQ(run.scene.crowd.size(), 9u);
  run.steps(1);
  EXPECT_EQ(run.state.id.size(), 3u);
  run.steps(24);
  EXPECT_EQ(run.state.id.size(), 6u);
  run.steps(124);
  EXPECT_EQ(run.state.id.size(), 6u);
  run.steps(1);
  EXPECT_EQ(run.state.id, (std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

/// m, how far apart the two of the first that are farthest from each other.
double spread(const State& state, std::size_t first, std::size_t count) {
  double most = 0.0;
  for (std::size_t a = first; a < first + count; ++a)
    for (std::size_t b = first; b < a; ++b)
      most = std::max(most, (state.position[a] - state.position[b]).norm());
  return most;
}

TEST(Entrance, WhoAppearTogetherStandBesideEachOther) {
  for (int seed = 1; seed <= 20; ++seed) {
    Trial run("seed = " + std::to_string(seed) +
              "\ntime = { dt = 0.02, until = 9 }\nwalkable = 'POLYGON ((0 0, 40 0, 40 40, 0 40, 0 0))'\n"
              "[areas]\nstart = [[0, 0], [38, 0], [38, 40], [0, 40]]\nexit = [[39, 0], [40, 0], [40, 40], "
              "[39, 40]]\n"
              "[[agents]]\nmodel = 'collision_free_speed'\ngoal = 'exit'\nplace.random.within = 'start'\n"
              "appear = { times = [0, 0], together = 4 }\n");
    run.steps(1);
    ASSERT_EQ(run.state.id.size(), 8u);
    EXPECT_LT(spread(run.state, 0, 4), 2.0) << seed;
    EXPECT_LT(spread(run.state, 4, 4), 2.0) << seed;
  }
}

TEST(Entrance, BringsNobodyInWhereNoWayLeads) {
  Trial run(entrance_hall(
      "goal = 'low'\ncount = 20\nappear = { rate = 10 }\n[[walls]]\nsegment = [[0, 3.2], [20, 3.2]]\n"));
  run.steps(1500);
  EXPECT_EQ(run.state.crowd.arrived, 20);
}

/// Why the hall is refused where a wall with a gap 0.6 m wide stands across it, and its agents are so wide.
std::string refusal_at_a_gap(const std::string& radius) {
  try {
    Trial run(entrance_hall(
        "goal = 'low'\ncount = 20\nappear = { rate = 1 }\nradius = " + radius +
        "\n[[walls]]\nsegment = [[9, 0], [9, 2.7]]\n[[walls]]\nsegment = [[9, 3.3], [9, 6]]\n"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// It happened: where some of a group find a way, those too wide for any never appeared, nor did who came
// after them.
TEST(Entrance, RefusesWhoIsTooWideForAnyWay) {
  EXPECT_EQ(refusal_at_a_gap("{ uniform = [0.2, 0.35] }"),
            "agents[0]: no way wide enough leads from anywhere that agent 3 of 20 (id 3, radius 0.314161 m) "
            "may appear to its goal \"low\"");
  EXPECT_EQ(refusal_at_a_gap("{ uniform = [0.2, 0.31] }").find("agents[0]: no way wide enough"), 0u);
  EXPECT_EQ(refusal_at_a_gap("{ uniform = [0.2, 0.295] }"), "accepted");
}

TEST(Entrance, IsNotRefusedForOnePlaceFromWhichNoWayLeads) {
  for (int seed = 1; seed <= 20; ++seed) {
    Scene scene = scene_from(entrance_hall(
        "goal = 'low'\ncount = 1\nappear = { rate = 1 }\n[[walls]]\nsegment = [[0, 2.5], [20, 2.5]]\n"));
    scene.bodies.position[0] = Vec(1.0, 3.2);  // drawn, and above the wall
    scene.seed = static_cast<std::uint64_t>(seed);
    EXPECT_NO_THROW(Walk{scene}) << seed;
  }
}

TEST(Entrance, LetsAgentsWaitUntilThereIsRoom) {
  Trial run(
      entrance_hall("goal = 'low'\ncount = 60\nradius = 0.25\nappear = { times = [0], together = 60 }\n"));
  run.steps(1);
  const std::size_t first = run.state.id.size();
  EXPECT_GT(first, 3u);
  EXPECT_LT(first, 16u) << "4 m² hold no more";
  for (int i = 0; i < 3000; ++i) {
    run.steps(1);
    for (std::size_t a = 0; a < run.state.id.size(); ++a) {
      if (run.state.crowd.stand_step[a] != run.state.step) continue;  // has just appeared, or moved on
      for (std::size_t b = 0; b < run.state.id.size(); ++b)
        if (a != b) {
          ASSERT_GT((run.state.position[a] - run.state.position[b]).norm(), 0.45) << i;
        }
    }
  }
  EXPECT_EQ(run.state.crowd.arrived, 60);
  EXPECT_EQ(waiting(run.state.crowd), 0u);
}

TEST(Entrance, PlacesAgentsWhollyWithinAndApart) {
  const Scene scene = scene_from(entrance_hall(
      "goal = 'low'\ncount = 400\nradius = 0.2\nplace.random.gap = 0.1\nappear = { rate = 1 }\n"));
  State state = initial_state(scene);
  const Barriers barriers(barrier_lines(scene), 1.0);
  const Sampler entrance(scene.crowd.groups[0].entrance->within, 0.2);
  Standing others;
  std::uint32_t agent = 0;
  for (std::optional<Vec> p; agent < 400 && (p = free_place(scene, barriers, others, entrance, agent, 0, {},
                                                            [](const Vec&) { return true; }));
       ++agent) {
    EXPECT_TRUE(p->x() >= 0.3 && p->x() <= 1.8 && p->y() >= 2.2 && p->y() <= 3.8) << p->transpose();
    for (const Vec& q : state.position) EXPECT_GE((*p - q).norm(), 0.5);
    add_agent(scene, state, agent, *p);
    others.add(*p, 0.2);
  }
  EXPECT_GT(agent, 4u);
  EXPECT_LT(agent, 20u);
}

TEST(Entrance, IsResumedToTheSameBitsWhileAgentsAppear) {
  const Scene scene =
      scene_from(entrance_hall("goal = ['middle', 'low']\ncount = 40\nappear = { rate = 4 }\n"));
  Trial whole(scene), first(scene), three(scene, 3);
  whole.steps(600), three.steps(600), first.steps(330);
  const std::string file = ::testing::TempDir() + "entrance.ckpt";
  recording::write_checkpoint(file, {"1", "", 0, 0}, first.state);
  const State read = recording::read_checkpoint(file).state;
  std::remove(file.c_str());
  ASSERT_TRUE(fits(read, scene));
  EXPECT_EQ(read.crowd.stage, first.state.crowd.stage);
  EXPECT_EQ(read.crowd.waiting, first.state.crowd.waiting);
  ASSERT_GT(waiting(read.crowd), 0u);
  Trial second(scene);
  second.state = read;
  second.steps(270);
  EXPECT_EQ(hash(second.state), hash(whole.state));
  EXPECT_EQ(hash(three.state), hash(whole.state));
  EXPECT_EQ(second.state.crowd.stage, whole.state.crowd.stage);
}

TEST(Entrance, FitsOnlyTheCrowdThatItIsOf) {
  const Scene scene =
      scene_from(entrance_hall("goal = ['middle', 'low']\ncount = 40\nappear = { rate = 4 }\n"));
  Trial run(scene);
  run.steps(100);
  const auto refused = [&](auto change) {
    State state = run.state;
    change(state);
    return !fits(state, scene);
  };
  EXPECT_FALSE(refused([](State&) {}));
  EXPECT_TRUE(refused([](State& s) { s.crowd.stage[0] = 2; }));
  EXPECT_TRUE(refused([](State& s) { s.crowd.waiting[0] = 41; }));
  EXPECT_TRUE(refused([](State& s) { s.crowd.waiting.push_back(0); }));
  EXPECT_TRUE(refused([](State& s) { s.crowd.measured.resize(1); }));
  EXPECT_TRUE(refused([](State& s) { s.crowd.on_line = {{0, 1, 0}}; })) << "there is no line";
  EXPECT_TRUE(refused([](State& s) { ++s.crowd.arrived; }));
  EXPECT_TRUE(refused([](State& s) { s.id.back() = 40; })) << "who is still to appear";
  const auto who_left = [&](std::uint32_t id) {
    return refused([&](State& s) {
      ++s.crowd.arrived, --s.crowd.waiting[0];
      s.crowd.arrivals.push_back(100), s.crowd.arrived_id.push_back(id);
    });
  };
  const std::uint32_t next = 41 - run.state.crowd.waiting[0];
  EXPECT_FALSE(who_left(next));
  EXPECT_TRUE(who_left(next + 1)) << "who is still to appear";
  EXPECT_TRUE(who_left(41)) << "nobody";
  EXPECT_TRUE(refused([](State& s) { for_each_agent_array(s.crowd, [](auto& all) { all.clear(); }); }));
  EXPECT_TRUE(refused([](State& s) { s.crowd.option[0] = 1; }));
  EXPECT_TRUE(refused([](State& s) { s.crowd.option[0] = kUndecided; })) << "there is no choice";
  EXPECT_TRUE(refused([](State& s) { s.crowd.place[0] = 1; })) << "neither a queue nor a place to wait";
}

TEST(Journey, GoesFromGoalToGoalAndLeavesAtTheLast) {
  Trial run(entrance_hall("goal = ['middle', 'low']\ncount = 1\n"));
  bool was_in_the_middle = false;
  for (int i = 0; i < 2000 && run.state.crowd.arrived == 0; ++i) {
    run.steps(1);
    if (run.state.id.empty()) break;
    const Vec& p = run.state.position[0];
    was_in_the_middle |= p.x() >= 9 && p.x() <= 11 && p.y() >= 5;
    EXPECT_EQ(run.state.crowd.stage[0], was_in_the_middle ? 1u : 0u);
  }
  EXPECT_TRUE(was_in_the_middle);
  EXPECT_EQ(run.state.crowd.arrived, 1);
  EXPECT_NEAR(run.state.crowd.arrivals.back() * 0.02, 18.5, 2.5)
      << "8.5 m up to the middle, 9.5 m down from it";
}

TEST(Journey, LeadsToTheNearestOfSeveralAreas) {
  Trial run(entrance_hall("goal = { nearest = ['low', 'high', 'middle'] }\ncount = 4\n"));
  run.steps(700);
  EXPECT_EQ(run.state.crowd.arrived, 4) << "all of them in the middle, within 14 s";
  Trial far(entrance_hall("goal = { nearest = ['low', 'high'] }\ncount = 4\n"));
  far.steps(700);
  EXPECT_EQ(far.state.crowd.arrived, 0);
  far.steps(800);
  EXPECT_EQ(far.state.crowd.arrived, 4);
}

TEST(Journey, IsDrawnByWeight) {
  for (const char* goal : {"goal.weights = { low = 3, high = 1, middle = 0 }\n",
                           "goal = [{ weights = { low = 3, high = 1, middle = 0 } }, 'middle']\n"}) {
    Trial run(
        entrance_hall("goal = 'low'\ncount = 0\n[[agents]]\nmodel = 'constant_velocity'\ncount = 2000\n"
                      "radius = 0.02\nplace.random.within = [[0, 0], [8, 6]]\n" +
                      std::string(goal)));
    const Leg& leg = run.scene.crowd.groups[1].journey[0];
    ASSERT_EQ(leg.options.size(), 2u) << "nobody goes to the middle";
    run.steps(1);
    std::size_t low = 0;
    for (const std::uint32_t option : run.state.crowd.option)
      low += run.scene.crowd.goals[leg.options[option]].name == "\"low\"";
    EXPECT_NEAR(low / 2000.0, 0.75, 3 * std::sqrt(0.75 * 0.25 / 2000));
  }
}

TEST(Premovement, LetsAgentsStandUntilTheirTime) {  // IMO MSC.1/Circ.1533, test 5
  Trial run(entrance_hall("goal = 'low'\ncount = 10\npremovement = { uniform = [1, 10] }\n"));
  std::vector<Vec> begin = run.state.position;
  std::vector<double> set_out(10, -1.0);
  for (int i = 1; i <= 520; ++i) {
    run.steps(1);
    for (std::size_t row = 0; row < run.state.id.size(); ++row) {
      const std::size_t agent = run.state.id[row] - 1;
      if (set_out[agent] < 0 && run.state.velocity[row].norm() > 0.5) set_out[agent] = i * 0.02;
    }
  }
  for (std::size_t agent = 0; agent < 10; ++agent) {
    EXPECT_GE(run.scene.crowd.start[agent], 1.0);
    EXPECT_LE(run.scene.crowd.start[agent], 10.0);
    EXPECT_GE(set_out[agent], run.scene.crowd.start[agent]);
    EXPECT_LE(set_out[agent], run.scene.crowd.start[agent] + 3.0) << "as soon as those in front let him";
  }
}

TEST(Premovement, IsNoReasonToCallAnAgentStuck) {
  Trial run(entrance_hall("goal = 'low'\ncount = 1\npremovement = 30\n"));
  run.steps(1400);
  EXPECT_TRUE(stuck_agents(run.scene, run.state).empty());
}

TEST(Journey, ExpectsAWayToEachOfItsGoals) {
  const std::string cut = "[[walls]]\nsegment = [[15, 0], [15, 6]]\n";
  EXPECT_NO_THROW(simulation(scene_from(entrance_hall("goal = 'middle'\n" + cut))));
  EXPECT_THROW(simulation(scene_from(entrance_hall("goal = ['middle', 'low']\n" + cut))), InputError);
  EXPECT_THROW(
      simulation(scene_from(entrance_hall("goal = 'low'\ncount = 3\nappear = { rate = 1 }\n" + cut))),
      InputError);
  EXPECT_NO_THROW(simulation(scene_from(entrance_hall("goal = { nearest = ['middle', 'low'] }\n" + cut))));
}

}  // namespace
}  // namespace throng
