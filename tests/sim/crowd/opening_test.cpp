// SPDX-License-Identifier: MIT
// Exits open and close while agents walk.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/crowd/stuck.h"
#include "sim/crowd/walk.h"
#include "sim/input_error.h"
#include "sim/recording/checkpoint.h"
#include "sim/simulation.h"
#include "tests/sim/crowd/hall.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

const std::string kClosesLow = "[open]\nlow = { until = 5 }\n";

/// Where the agents were when they were seen last.
std::vector<Vec> last_seen(Trial& run, int steps) {
  std::vector<Vec> last = run.state.position;
  for (int i = 0; i < steps && !run.state.id.empty(); ++i) {
    run.steps(1);
    for (std::size_t row = 0; row < run.state.id.size(); ++row)
      last[run.state.id[row] - 1] = run.state.position[row];
  }
  return last;
}

TEST(Opening, SendsThoseWhoHaveTheChoiceToAnotherExitOnceTheirsCloses) {
  for (const char* goal : {"goal.nearest = ['low', 'high']\n", "goal.weights = { low = 1, high = 1e-9 }\n",
                           "goal.least_crowded = { low = 1000, high = 0.01 }\n"}) {
    SCOPED_TRACE(goal);
    const std::string group = "count = 8\nradius = 0.2\n" + std::string(goal);
    Trial open(hall(group)), closes(hall(group + kClosesLow));
    for (Trial* run : {&open, &closes})
      for (std::size_t row = 0; row < 8; ++row)
        run->state.position[row].y() = 0.5 + 0.5 * static_cast<double>(row);
    const std::vector<Vec> there = last_seen(open, 2500), then = last_seen(closes, 2500);
    EXPECT_EQ(open.state.crowd.arrived, 8);
    EXPECT_EQ(closes.state.crowd.arrived, 8);
    for (const Vec& p : there) EXPECT_LT(p.y(), 3.0);
    for (const Vec& p : then) EXPECT_GT(p.y(), 7.0);
  }
}

TEST(Opening, LetsWaitBeforeTheOnlyExitUntilItOpens) {
  Trial run(hall("count = 8\nradius = 0.2\ngoal = 'low'\n[open]\nlow = { from = 60 }\n"));
  run.steps(2990);
  EXPECT_EQ(run.state.crowd.arrived, 0);
  EXPECT_TRUE(stuck_agents(run.scene, run.state).empty()) << "they wait";
  for (const Vec& p : run.state.position) EXPECT_LT((p - Vec(29.5, 1)).norm(), 4.0);
  run.steps(500);
  EXPECT_EQ(run.state.crowd.arrived, 8);
}

// Who wanted in and couldn't turned this way and that at 0.3 m/s, and those behind with him.
TEST(Opening, LetsThemStandStillBeforeAClosedExit) {
  const std::string narrow =
      "[[walls]]\nsegment = [[6, 2], [30, 2]]\n";  // those in a column can't gather round the exit
  for (const char* model : {"collision_free_speed", "social_force", "orca"})
    for (const std::string& walls : {std::string(), narrow}) {
      SCOPED_TRACE(model + walls);
      Trial run(
          hall("count = 20\nradius = 0.2\ngoal = 'low'\n[open]\nlow = { from = 100 }\n" + walls, model));
      run.steps(4000);
      const std::vector<Vec> before = run.state.position;
      std::vector<double> way(before.size(), 0.0);
      for (int i = 0; i < 500; ++i) {
        run.steps(1);
        for (std::size_t row = 0; row < way.size(); ++row) way[row] += 0.02 * run.state.velocity[row].norm();
      }
      for (const double each : way) EXPECT_LT(each, 0.1) << "m in 10 s";
      EXPECT_TRUE(stuck_agents(run.scene, run.state).empty());
      EXPECT_TRUE(fits(run.state, run.scene)) << "it can be resumed";
      for (const Vec& p : run.state.position) EXPECT_GT(p.x(), 18.0) << "near the exit";
      run.steps(2500);
      EXPECT_EQ(run.state.crowd.arrived, 20);
    }
}

// It happened: who met those who wait through a wall stopped there, metres of way from the exit, and plugged
// the corridor for all behind him.
TEST(Opening, LetsThemComeRoundAWallToThoseWhoWaitBehindIt) {
  for (const std::string model : {"collision_free_speed", "social_force", "orca"}) {
    SCOPED_TRACE(model);
    Trial run(
        "time = { dt = 0.02, until = 1000 }\nwalkable = 'POLYGON ((0 0, 9 0, 9 1.5, 0 1.5, 0 0.8, 8 0.8, 8 "
        "0.7, 0 0.7, 0 0))'\n[areas]\nexit = [[0, 0.8], [0.5, 0.8], [0.5, 1.5], [0, 1.5]]\n[open]\nexit = "
        "{ from = 60 }\n[[agents]]\ncount = 8\nradius = 0.2\ndesired_speed = 1\ngoal = 'exit'\n"
        "place.random.within = [[0, 0], [8, 0.7]]\nmodel = '" +
        model + "'\n");
    for (int row = 0; row < 8; ++row)
      run.state.position[row] = Vec(0.6 + 0.5 * (row % 4), row < 4 ? 1.05 : 0.45);
    run.steps(2900);
    EXPECT_EQ(run.state.crowd.arrived, 0);
    for (const Vec& p : run.state.position) {
      EXPECT_GT(p.y(), 0.8) << "in the leg of the exit";
      EXPECT_LT(p.x(), 7.0) << "behind the one before";
    }
    EXPECT_TRUE(stuck_agents(run.scene, run.state).empty()) << "they wait";
    run.steps(1600);
    EXPECT_EQ(run.state.crowd.arrived, 8);
  }
}

/// The README's crowd: some go for the exit, others line up at a till and wait at a counter before.
std::string shop(int seed) {
  return "time = { dt = 0.01, until = 1000 }\nseed = " + std::to_string(seed) +
         "\nwalkable = 'POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), (4 2, 5 2, 5 3, 4 3, 4 2))'\n[areas]\n"
         "start = [[0, 0], [3, 0], [3, 5], [0, 5]]\nexit = [[9.5, 2], [10, 2], [10, 3], [9.5, 3]]\n"
         "counter = [[6, 3.5], [9, 3.5], [9, 5], [6, 5]]\n[open]\nexit = { until = 60 }\n"
         "[queues]\ntill = { line = [[7, 1], [4, 1]], service = 2 }\n"
         "[[measure]]\nname = 'door'\nline = [[9, 0], [9, 5]]\n"
         "[[agents]]\ncount = 40\nplace.random.within = 'start'\nradius = { uniform = [0.18, 0.22] }\n"
         "desired_speed = { normal = [1.34, 0.26], within = [0.5, 2.2] }\nmodel = 'social_force'\n"
         "social_force = { preset = 'calibrated', mass = 75 }\ngoal = 'exit'\n"
         "premovement = { uniform = [0, 5] }\n"
         "[[agents]]\ncount = 30\nappear = { rate = 2, from = 10 }\nplace.random.within = 'start'\n"
         "model = 'collision_free_speed'\n"
         "goal = [{ queue = 'till' }, { wait = 'counter', for = { uniform = [5, 30] } }, 'exit']\n";
}

// They who wanted to the counter were kept out by those who waited for the exit, turned this way and that at
// up to 1.3 m/s, were listed as stuck, and counted at the door each time that they trembled over its line.
TEST(Opening, LetsThemStandStillWhereWhoWaitsForOneThingIsInTheWayToAnother) {
  for (const int seed : {1, 2, 3, 4}) {
    SCOPED_TRACE(seed);
    Trial run(shop(seed));
    run.steps(16000);
    std::vector<double> way(run.state.id.size(), 0.0);
    ASSERT_GT(way.size(), 10u) << "who came too late";
    const std::int64_t counted = run.state.crowd.measured[0].count + run.state.crowd.measured[0].back;
    for (int i = 0; i < 1000; ++i) {
      run.steps(1);
      for (std::size_t row = 0; row < way.size(); ++row) way[row] += 0.01 * run.state.velocity[row].norm();
    }
    for (std::size_t row = 0; row < way.size(); ++row)
      EXPECT_LT(way[row], 0.1) << "m in 10 s, agent " << run.state.id[row];
    EXPECT_TRUE(stuck_agents(run.scene, run.state).empty());
    EXPECT_EQ(run.state.crowd.measured[0].count + run.state.crowd.measured[0].back, counted);
    EXPECT_LE(counted, 110) << "crossings of 70 people";
  }
}

TEST(Opening, KeepsThemAtAClosedExitUntilAnotherOpens) {
  Trial run(
      hall("count = 8\nradius = 0.2\ngoal.least_crowded = ['low', 'high']\n[open]\nlow = { from = 70 }\n"
           "high = { until = 1 }\n"));
  const std::vector<Vec> last = last_seen(run, 5000);
  EXPECT_EQ(run.state.crowd.arrived, 8);
  for (const Vec& p : last) EXPECT_LT(p.y(), 3.0);
  EXPECT_GT(run.state.step, 3500);
}

TEST(Opening, IsDrawnAnewByTheWeightsOfWhatIsOpen) {
  Trial run(
      hall("count = 0\ngoal = 'low'\n[[agents]]\nmodel = 'constant_velocity'\ncount = 1000\nradius = "
           "0.02\nplace.random.within = 'start'\ngoal.weights = { low = 3, high = 1, platform = 4 }\n"
           "[open]\nplatform = { until = 2 }\n"));
  run.steps(1);
  const Leg& leg = run.scene.crowd.groups[1].journey[0];
  const auto count = [&](const std::string& name) {
    return static_cast<double>(std::ranges::count_if(run.state.crowd.option, [&](std::uint32_t option) {
      return run.scene.crowd.goals[leg.options[option]].name == name;
    }));
  };
  EXPECT_NEAR(count("\"platform\""), 500, 3 * std::sqrt(1000 * 0.25));
  const double low = count("\"low\"");
  run.steps(110);
  EXPECT_EQ(count("\"platform\""), 0);
  EXPECT_NEAR(count("\"low\"") - low, 0.75 * 500, 0.08 * 500) << "three of four of those who change";
}

/// A thousand who draw one of two exits by 9 to 1 when they set out.
std::string drawers(const std::string& more) {
  return hall(
      "count = 0\ngoal = 'low'\n[[agents]]\nmodel = 'constant_velocity'\ncount = 1000\nradius = 0.02\n"
      "place.random.within = 'start'\ngoal.weights = { low = 9, high = 1 }\n" +
      more);
}

// It happened: who set out after 3 s to what had opened after 2 s drew at the start, when it was closed.
TEST(Opening, IsHeededByWhoDrawsWhenHeSetsOut) {
  Trial run(drawers("premovement = 3\n[open]\nlow = { from = 2 }\n"));
  run.steps(149);
  for (const std::uint32_t option : run.state.crowd.option) EXPECT_EQ(option, kUndecided);
  EXPECT_TRUE(fits(run.state, run.scene)) << "it can be resumed";
  run.steps(2);
  const Leg& leg = run.scene.crowd.groups[1].journey[0];
  const auto low = std::ranges::count_if(run.state.crowd.option, [&](std::uint32_t option) {
    return run.scene.crowd.goals[leg.options.at(option)].name == "\"low\"";
  });
  EXPECT_NEAR(static_cast<double>(low), 900, 3 * std::sqrt(1000 * 0.09));
}

TEST(Opening, LetsThemDrawTheSameWhenTheySetOutWhereNothingIsClosed) {
  Trial run(drawers(""));
  run.steps(1);
  for (const char* more : {"premovement = 3\n", "premovement = 3\n[open]\nlow = { until = 900 }\n",
                           "[open]\nlow = { until = 900 }\n"}) {
    Trial later(drawers(more));
    later.steps(151);
    EXPECT_EQ(later.state.crowd.option, run.state.crowd.option) << more;
  }
}

TEST(Opening, IsResumedToTheSameBits) {
  const Scene scene = scene_from(
      hall("count = 30\nradius = 0.2\ngoal.weights = { low = 1, high = 1 }\n[open]\nlow = { until = 10 }\n"
           "high = { from = 4, until = 15 }\n"));
  Trial whole(scene), two(scene, 2);
  whole.steps(1300), two.steps(1300);
  EXPECT_EQ(hash(two.state), hash(whole.state));
  for (const int at : {150, 500, 501, 740, 760}) {
    Trial first(scene);
    first.steps(at);
    const std::string file = ::testing::TempDir() + "opening.ckpt";
    recording::write_checkpoint(file, {"1", "", 0, 0}, first.state);
    Trial second(scene);
    second.state = recording::read_checkpoint(file).state;
    std::remove(file.c_str());
    second.steps(1300 - at);
    EXPECT_EQ(hash(second.state), hash(whole.state)) << at;
    EXPECT_EQ(second.state.crowd, whole.state.crowd) << at;
  }
}

TEST(Opening, ExpectsAWayToWhatIsOpen) {
  const std::string scene =
      hall("goal.nearest = ['platform', 'low']\n[[walls]]\nsegment = [[24, 0], [24, 10]]\n");
  EXPECT_NO_THROW(simulation(scene_from(scene)));
  try {
    simulation(scene_from(scene + "[open]\nplatform = { until = 7 }\n"));
    ADD_FAILURE() << "was let run";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"platform\" or \"low\", as it is open from 7 s on"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace throng
