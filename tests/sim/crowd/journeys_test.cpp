// SPDX-License-Identifier: MIT
// What agents do on their journeys: wait, line up, choose.
#include "sim/crowd/journeys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/crowd/stuck.h"
#include "sim/crowd/walk.h"
#include "sim/recording/checkpoint.h"
#include "tests/less_when_watched.h"
#include "tests/sim/crowd/hall.h"
#include "tests/sim/crowd/models.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

TEST(Waiting, StandsApartInTheAreaForItsTime) {
  for (const char* model : {"collision_free_speed", "social_force", "orca"}) {
    SCOPED_TRACE(model);
    Trial run(hall(
        "count = 15\nradius = 0.2\ngoal = [{ wait = 'platform', for = { uniform = [30, 40] } }, 'low']\n",
        model));
    run.steps(1700);
    ASSERT_EQ(run.state.id.size(), 15u);
    for (std::size_t a = 0; a < 15; ++a) {
      const Vec& p = run.state.position[a];
      EXPECT_EQ(run.state.crowd.place[a], 1u) << a;
      const Vec& spot = run.state.crowd.spot[a];
      EXPECT_TRUE(spot.x() >= 12 && spot.x() <= 16 && spot.y() >= 0 && spot.y() <= 3) << spot.transpose();
      EXPECT_LT((p - spot).norm(), 0.5) << a;
      EXPECT_LT(run.state.velocity[a].norm(), 0.5) << a;
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_GT((p - run.state.position[b]).norm(), 0.35) << a << ' ' << b;
    }
    EXPECT_TRUE(stuck_agents(run.scene, run.state).empty());
    const std::vector<std::int64_t> since = run.state.crowd.since;
    for (int i = 0; i < 1400 && run.state.crowd.arrived == 0; ++i) {
      run.steps(1);
      for (std::size_t row = 0; row < run.state.crowd.stage.size(); ++row)
        if (run.state.crowd.stage[row] == 1 && run.state.crowd.since[row] == run.state.step) {
          const double waited = static_cast<double>(run.state.step - since[run.state.id[row] - 1]) * 0.02;
          EXPECT_TRUE(waited >= 30 && waited <= 40.02) << waited;
        }
    }
    run.steps(2500);
    EXPECT_EQ(run.state.crowd.arrived, 15);
  }
}

TEST(Waiting, EndsAtItsTimeForAll) {
  Trial run(hall("count = 10\ngoal = [{ wait = 'platform', until = 40 }, 'low']\n"));
  run.steps(1999);
  for (const std::uint32_t stage : run.state.crowd.stage) EXPECT_EQ(stage, 0u) << "39.98 s";
  run.steps(1);
  for (const std::uint32_t stage : run.state.crowd.stage) EXPECT_EQ(stage, 1u) << "40 s";
}

TEST(Waiting, WithoutAnEndIsForEver) {
  Trial run(hall("count = 10\ngoal = { wait = 'platform' }\n"));
  run.steps(5000);
  EXPECT_EQ(run.state.id.size(), 10u);
  for (const Vec& p : run.state.position) EXPECT_TRUE(p.x() > 12 && p.x() < 16 && p.y() < 3);
}

// It happened: the first to come stood all over the area, the others behind them, and of 160 people 52 stayed
// outside, packed, beside an area whose farther half held five.
TEST(Waiting, FillsTheAreaFromTheFarSide) {
  for (const int count : {40, 80, 160}) {
    Trial run(
        "time = { dt = 0.05, until = 260 }\nwalkable = 'POLYGON ((0 0, 40 0, 40 4, 0 4, 0 0))'\n"
        "areas.start = [[0, 0], [4, 0], [4, 4], [0, 4]]\n"
        "areas.platform = [[10, 0], [40, 0], [40, 4], [10, 4]]\n"
        "[[agents]]\nappear.rate = 1\nplace.random.within = 'start'\nradius = 0.22\n"
        "model = 'collision_free_speed'\ndesired_speed = 1.3\ngoal.wait = 'platform'\ncount = " +
        std::to_string(count) + "\n");
    run.steps(5200);
    ASSERT_EQ(run.state.id.size(), static_cast<std::size_t>(count));
    const auto beyond = [&](double x) {
      return std::ranges::count_if(run.state.position, [x](const Vec& p) { return p.x() > x; });
    };
    EXPECT_EQ(beyond(10), count);
    EXPECT_GE(3 * beyond(25), count) << "in the farther half";
  }
}

// It happened: of 960 people 58 stood beside a platform that had room (27 now), as none of the first three
// places that they drew had a way to it with nobody in it, however often they drew. Some are behind a closed
// row.
TEST(Waiting, GoesInWhereverThereIsAClearWayToRoom) {
  std::ptrdiff_t outside = 0;
  for (int seed = 1; seed <= 8; ++seed) {
    Trial run("seed = " + std::to_string(seed) +
              "\ntime = { dt = 0.05, until = 150 }\nwalkable = 'POLYGON ((0 0, 50 0, 50 8, 0 8, 0 0))'\n"
              "areas.start = [[0, 0], [4, 0], [4, 8], [0, 8]]\n"
              "areas.platform = [[10, 4], [45, 4], [45, 7.5], [10, 7.5]]\n"
              "[[agents]]\ncount = 120\nappear.rate = 2\nplace.random.within = 'start'\n"
              "radius = { uniform = [0.2, 0.24] }\nmodel = 'collision_free_speed'\n"
              "collision_free_speed.time_gap = 0.5\n"
              "desired_speed = { normal = [1.34, 0.26], within = [0.8, 1.8] }\ngoal.wait = 'platform'\n");
    run.steps(3000);
    ASSERT_EQ(run.state.id.size(), 120u);
    outside += std::ranges::count_if(
        run.state.position, [&](const Vec& p) { return !contains(run.scene.crowd.areas[0].region, p); });
  }
  EXPECT_LE(outside, 35);
}

TEST(Waiting, StandsWhereItGotToWhereThereIsNoRoom) {
  Trial run(hall("count = 40\nradius = 0.25\ngoal = [{ wait = 'platform', until = 60 }, 'low']\n"));
  run.steps(2900);
  double sum = 0.0, there = 0.0;
  for (std::size_t row = 0; row < run.state.id.size(); ++row)
    if (run.state.crowd.place[row] > 0) sum += run.state.velocity[row].norm(), there += 1.0;
  EXPECT_GT(there, 20);
  EXPECT_LT(sum / there, 0.2) << "12 m² hold no more than about 30, who keep pushing each other";
  run.steps(4000);
  EXPECT_EQ(run.state.crowd.arrived, 40);
}

// The README's crowd once had a counter too small for those who came: who found no room pushed in, who had
// waited pushed out, and 22 stood there for ever.
TEST(Waiting, BeforeAnAreaThatIsFullHoldsUpNobodyWhoWantsOut) {
  for (const char* model : {"collision_free_speed", "social_force", "orca"}) {
    SCOPED_TRACE(model);
    Trial run(
        "time = { dt = 0.02, until = 1000 }\n"
        "walkable = 'POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), (4 2, 5 2, 5 3, 4 3, 4 2))'\n[areas]\n"
        "start = [[0, 0], [3, 0], [3, 5], [0, 5]]\nexit = [[9.5, 2], [10, 2], [10, 3], [9.5, 3]]\n"
        "counter = [[6, 4.5], [7, 4.5], [7, 5], [6, 5]]\n"
        "[[agents]]\ncount = 40\nappear = { rate = 2 }\nplace.random.within = 'start'\nmodel = '" +
        std::string(model) + "'\ngoal = [{ wait = 'counter', for = { uniform = [5, 30] } }, 'exit']\n");
    run.steps(15000);
    EXPECT_EQ(run.state.crowd.arrived, 40);
  }
}

// It happened: forty who wanted to wait for 10 s where there is room for one went round and round before it,
// and the last was served after 158 s.
TEST(Waiting, BeforeAPlaceForOneBeginsThoughNobodyStands) {
  for (const char* model : {"collision_free_speed", "social_force", "orca"}) {
    SCOPED_TRACE(model);
    Trial run(
        "time = { dt = 0.02, until = 1000 }\nseed = 3\nwalkable = 'POLYGON ((0 0, 20 0, 20 8, 0 8, 0 0))'\n"
        "[areas]\nstart = [[0, 0], [5, 0], [5, 8], [0, 8]]\nexit = [[19, 0], [20, 0], [20, 8], [19, 8]]\n"
        "spot = [[10, 4], [10.2, 4], [10.2, 4.2], [10, 4.2]]\n"
        "[[agents]]\ncount = 40\nplace.random.within = 'start'\nmodel = '" +
        std::string(model) + "'\ngoal = [{ wait = 'spot', for = 10 }, 'exit']\n");
    run.steps(50 * 100);
    EXPECT_EQ(run.state.crowd.arrived, 40);
  }
}

constexpr int kJams = static_cast<int>(less_when_watched(12));  // draws of the crowd

std::string jam_beside_a_bystander(const char* model, int seed) {
  return "time = { dt = 0.02, until = 200 }\nseed = " + std::to_string(seed) +
         "\nwalkable = 'POLYGON ((0 0, 6 0, 6 2.5, 6.2 2.5, 6.2 0, 16 0, 16 6, 6.2 6, 6.2 3.5, 6 3.5, 6 6, 0 "
         "6, 0 0))'\n[areas]\nstart = [[0, 0], [5, 0], [5, 6], [0, 6]]\n"
         "post = [[5, 3.7], [5.8, 3.7], [5.8, 4.3], [5, 4.3]]\n"
         "hall = [[8, 0.5], [15.5, 0.5], [15.5, 5.5], [8, 5.5]]\n"
         "[[agents]]\ncount = 1\nradius = 0.2\nplace.random.within = 'post'\n"
         "goal = [{ wait = 'post' }]\nmodel = '" +
         model +
         "'\n[[agents]]\ncount = 80\nradius = 0.2\nplace.random.within = 'start'\n"
         "goal = [{ wait = 'hall' }]\nmodel = '" +
         model + "'\n";
}

// It happened: of eighty people on their way to a hall up to eighteen stayed for ever in the jam before its
// door, where one stood who waited for something else. And, with one draw of the crowd in three, some gave up
// beside him before the jam had passed, or were stuck between him and the wall.
TEST(Waiting, OfABystanderStopsNobodyInAJamBesideHim) {
  for (const char* model : {"collision_free_speed", "social_force"})
    for (int seed = 1; seed <= kJams; ++seed) {
      SCOPED_TRACE(model + (", seed " + std::to_string(seed)));
      Trial run(scene_from(jam_beside_a_bystander(model, seed)));
      run.steps(6000);
      for (std::size_t row = 1; row < run.state.id.size(); ++row)
        EXPECT_GT(run.state.position[row].x(), 6.2) << run.state.id[row];
    }
}

// It happened: who was pushed round the end of a wall pressed against it, straight towards his place, until
// he gave that up.
TEST(Waiting, ComesBackRoundTheWallBehindWhichItIsPushed) {
  Trial run(
      "time = { dt = 0.02, until = 200 }\nwalkable = 'POLYGON ((0 0, 10 0, 10 3, 0 3, 0 0))'\n"
      "walls = [{ segment = [[5, 0], [5, 2]] }]\nareas.post = [[5.2, 0], [6.2, 0], [6.2, 1], [5.2, 1]]\n"
      "[[agents]]\nat = [9, 1]\ngoal = { wait = 'post' }\nmodel = 'collision_free_speed'\n");
  run.steps(500);
  ASSERT_EQ(run.state.crowd.place[0], 1u);
  const Vec spot = run.state.crowd.spot[0];
  EXPECT_LT((run.state.position[0] - spot).norm(), 0.1);
  run.state.position[0] = Vec(4.6, 0.5);
  run.steps(500);
  EXPECT_EQ(run.state.crowd.spot[0], spot);
  EXPECT_LT((run.state.position[0] - spot).norm(), 0.1);
}

TEST(LeastCrowded, IsChosenWhenTheySetOut) {
  Trial run(hall("count = 5\ngoal.least_crowded = ['low', 'high']\npremovement = 1\n"));
  run.steps(49);
  for (const std::uint32_t option : run.state.crowd.option) EXPECT_EQ(option, kUndecided);
  EXPECT_TRUE(fits(run.state, run.scene));
  run.steps(2);
  for (const std::uint32_t option : run.state.crowd.option) EXPECT_LT(option, 2u);
}

TEST(LeastCrowded, SharesTheWaysOutByTheirCapacity) {
  Trial run(hall("count = 60\nradius = 0.1\ngoal = { least_crowded = { low = 0.1, high = 0.3 } }\n"));
  run.steps(1);
  const Leg& leg = run.scene.crowd.groups[0].journey[0];
  ASSERT_EQ(leg.options.size(), 2u);
  const auto low = std::ranges::count_if(run.state.crowd.option, [&](std::uint32_t option) {
    return run.scene.crowd.goals[leg.options[option]].name == "\"low\"";
  });
  EXPECT_NEAR(low, 15, 2) << "a quarter: the ways are about equally long";
}

TEST(LeastCrowded, TakesTheNearestWhereNobodyIsInTheWay) {
  const std::string at =
      "\n[[agents]]\nmodel = 'constant_velocity'\ngoal.least_crowded = ['high', 'low']\nat = ";
  Trial run(hall("count = 0\ngoal = 'low'" + at + "[10, 9]" + at + "[20, 1]" + at + "[15, 4]\n"));
  run.steps(1);
  const auto name = [&](std::size_t row) {
    const Leg& leg = run.scene.crowd.leg(row, 0);
    return run.scene.crowd.goals[run.scene.crowd.goal(leg, run.state.crowd.option[row])].name;
  };
  EXPECT_EQ(name(0), "\"high\"");
  EXPECT_EQ(name(1), "\"low\"");
  EXPECT_EQ(name(2), "\"high\"") << "14.1 m against 14.6, but who goes to `low` is nearer: 0.8 s more";
}

/// Who wants to one of two exits, and is carried into the other in his second step.
State carried(const std::string& goal, const std::string& more = "") {
  Trial run("time = { dt = 0.02, until = 100 }\n" + more +
            "walkable = 'POLYGON ((0 0, 30 0, 30 10, 0 10, 0 0))'\n[areas]\n"
            "start = [[0, 2], [4, 2], [4, 8], [0, 8]]\nlow = [[25, 0], [27, 0], [27, 2], [25, 2]]\n"
            "high = [[25, 8], [27, 8], [27, 10], [25, 10]]\n"
            "[[agents]]\nat = [10, 6]\nmodel = 'constant_velocity'\ngoal = " +
            goal + "\n");
  run.steps(1);
  const Leg& leg = run.scene.crowd.groups[0].journey[0];
  const bool goes_high = run.scene.crowd.goals[leg.options[run.state.crowd.option[0]]].name == "\"high\"";
  run.state.position[0] = Vec(26, goes_high ? 1 : 9);
  run.steps(1);
  return run.state;
}

// It happened: who was carried into another exit than he had chosen turned round in it and walked back
// against all who wanted out: before two doors the last of 150 people was out after 80 s, and is after 25 s.
TEST(LastGoal, OfSeveralIsWhicheverTheyGetTo) {
  for (const char* goal : {"{ least_crowded = ['low', 'high'] }", "{ weights = { low = 1, high = 2 } }",
                           "{ nearest = ['low', 'high'] }", "['high', { least_crowded = ['low', 'high'] }]"})
    EXPECT_EQ(carried(goal).crowd.arrived, goal[0] == '{') << goal;
}

TEST(LastGoal, IsNoGoalOnTheWay) {
  const State state = carried("[{ least_crowded = ['low', 'high'] }, 'start']");
  EXPECT_EQ(state.crowd.stage[0], 0u);
}

TEST(LastGoal, OfSeveralIsNoneThatIsClosed) {
  EXPECT_EQ(carried("{ least_crowded = ['low', 'high'] }", "open.low.from = 50\n").crowd.arrived, 0);
  EXPECT_EQ(carried("{ least_crowded = ['low', 'high'] }", "open.high.from = 50\n").crowd.arrived, 0);
}

TEST(LastGoal, OfSeveralIsReachedByWhoStepsOverIt) {
  Trial run(
      "time = { dt = 0.02, until = 100 }\nwalkable = 'POLYGON ((0 0, 30 0, 30 10, 0 10, 0 0))'\n[areas]\n"
      "far = [[28, 0], [29, 0], [29, 10], [28, 10]]\nline = [[12, 0], [12.001, 0], [12.001, 10], [12, 10]]\n"
      "[[agents]]\nat = [10, 6]\nmodel = 'constant_velocity'\ndesired_speed = 1\n"
      "goal = { weights = { line = 1e-6, far = 1e6 } }\n");
  run.steps(98);
  ASSERT_EQ(run.state.crowd.arrived, 0);
  run.steps(4);
  EXPECT_EQ(run.state.crowd.arrived, 1);
}

TEST(LeastCrowded, ByHand) {  // 16 m at 1 m/s to either; four who are nearer at `high`, none at `low`
  const std::string agents =
      "[[agents]]\nmodel = 'constant_velocity'\ngoal = 'high'\nplace.random.within = [[25, 8], [28, "
      "10]]\ncount = 4\n"
      "[[agents]]\nmodel = 'constant_velocity'\ndesired_speed = 1\nat = [13, ";
  const auto option = [&](const std::string& y, const std::string& per_second) {
    Trial run(hall("count = 0\ngoal = 'low'\n" + agents + y +
                   "]\ngoal.least_crowded = { high = " + per_second + ", low = 1 }\n"));
    run.steps(1);
    const Leg& leg = run.scene.crowd.leg(4, 0);
    return run.scene.crowd.goals[leg.options[run.state.crowd.option[4]]].name;
  };
  EXPECT_EQ(option("6", "16"), "\"high\"") << "16.12 + 4 / 16 s against 16.49 s";
  EXPECT_EQ(option("6", "8"), "\"low\"") << "16.12 + 4 / 8 s against 16.49 s";
  EXPECT_EQ(option("7", "8"), "\"high\"") << "16.03 + 4 / 8 s against 16.76 s";
  EXPECT_EQ(option("7", "1"), "\"low\"") << "16.03 + 4 against 16.76 s";
}

TEST(LeastCrowded, ChoosesAmongQueuesByTheirService) {
  Trial run(hall("count = 20\nradius = 0.2\ngoal = [{ queue = ['gate', 'fast'] }, 'low']\n"));
  run.steps(1);
  const auto slow = std::ranges::count(run.state.crowd.option, 0u);
  EXPECT_TRUE(slow > 2 && slow < 10) << slow << ": the gate is 3 m nearer, and served a quarter as fast";
  run.steps(3000);
  EXPECT_EQ(run.state.crowd.arrived, 20);
}

std::string everything() {
  return hall(
      "count = 40\nradius = 0.2\nappear = { rate = 4 }\n"
      "goal = [{ wait = 'platform', for = { uniform = [1, 5] } }, { queue = ['gate', 'fast'] }, { "
      "least_crowded = ['low', 'high'] }]\n");
}

// It happened: who stepped over an exit thinner than his step turned, stepped over it again, and so on.
TEST(Journeys, ReachWhatIsThinnerThanAStep) {
  for (const char* model : kModels) {
    SCOPED_TRACE(model);
    Trial run(
        "time = { dt = 0.02, until = 100 }\nwalkable = 'POLYGON ((0 0, 12 0, 12 2, 0 2, 0 0))'\n[areas]\n"
        "gate = [[3, 0], [3.0005, 0], [3.0005, 2], [3, 2]]\n"
        "stop = [[6, 0], [6.0005, 0], [6.0005, 2], [6, 2]]\n"
        "exit = [[9, 0], [9.0005, 0], [9.0005, 2], [9, 2]]\n"
        "[[agents]]\nat = [1, 1]\ndesired_speed = 1\ngoal = ['gate', { wait = 'stop', for = 1 }, 'exit']\n"
        "model = '" +
        std::string(model) + "'\n");
    run.steps(50 * 11);
    EXPECT_EQ(run.state.crowd.arrived, 1) << "8 m at 1 m/s, a stop, and starts";
  }
}

// It happened: who stood in his exit left in the first step, and who stood where he was to wait, or at the
// end of a queue, waited and was served during his premovement.
TEST(Journeys, BeginWithNothingBeforeTheySetOut) {
  for (const char* model : kModels)
    for (const auto& [at, goal] : {std::pair("[29.5, 1]", "'low'"),
                                   {"[29.5, 1]", "{ nearest = ['low', 'high'] }"},
                                   {"[29.5, 1]", "['low', 'high']"},
                                   {"[14, 1]", "[{ wait = 'platform', for = 1 }, 'low']"},
                                   {"[20, 5]", "[{ queue = 'gate' }, 'low']"}}) {
      SCOPED_TRACE(model + std::string(goal));
      Trial run(
          hall("count = 0\ngoal = 'low'\n[[agents]]\nradius = 0.2\ndesired_speed = 1\npremovement = "
               "3\nat = " +
               std::string(at) + "\ngoal = " + goal + "\nmodel = '" + model + "'\n"));
      run.steps(149);
      ASSERT_EQ(run.state.crowd.arrived, 0);
      EXPECT_EQ(run.state.crowd.stage[0], 0u);
      EXPECT_EQ(run.state.crowd.place[0], 0u);
      EXPECT_TRUE(fits(run.state, run.scene));
      run.steps(2);
      EXPECT_EQ(run.state.crowd.arrived +
                    (run.state.id.empty() ? 0 : run.state.crowd.stage[0] + run.state.crowd.place[0]),
                1);
    }
}

// It happened: who stood for longer than kPatience beside others who wait, before he set out, stayed there.
TEST(Journeys, HaveNotBeenKeptOutBeforeTheySetOut) {
  const auto one = [](const std::string& at, const std::string& goal) {
    return "[[agents]]\nradius = 0.2\ndesired_speed = 1\nmodel = 'constant_velocity'\nat = " + at +
           "\ngoal = " + goal + "\n";
  };
  for (const char* premovement : {"0", "6", "20"}) {
    SCOPED_TRACE(premovement);
    Trial run(
        "time = { dt = 0.02, until = 1000 }\nwalkable = 'POLYGON ((0 0, 30 0, 30 6, 0 6, 0 0))'\n"
        "[areas]\nnear = [[9.5, 2.9], [9.9, 2.9], [9.9, 3.1], [9.5, 3.1]]\n"
        "beside = [[9.5, 3.5], [9.9, 3.5], [9.9, 3.7], [9.5, 3.7]]\n"
        "exit = [[29, 2], [30, 2], [30, 4], [29, 4]]\n[open]\nexit = { from = 100 }\n" +
        one("[9.7, 3]", "{ wait = 'near' }") + one("[9.7, 3.6]", "{ wait = 'beside' }") +
        one("[10.2, 3.3]", "'exit'") + "premovement = " + premovement + "\n");
    run.steps(50 * (std::stoi(premovement) + 20));
    EXPECT_GT(run.state.position[2].x(), 28.0);
  }
}

// As a stranger had it: 20 s of premovement, 5 s in the area, 9 m at 1 m/s.
TEST(Waiting, LastsAsLongAsItIsToFromWhenTheySetOut) {
  Trial run(
      hall("count = 0\ngoal = 'low'\n[[agents]]\nat = [14, 1]\ndesired_speed = 1\npremovement = 20\n"
           "model = 'constant_velocity'\ngoal = [{ wait = 'platform', for = 5 }, 'low']\n"));
  run.steps(50 * 38);
  EXPECT_EQ(run.state.crowd.arrived, 0);
  run.steps(50 * 4);
  EXPECT_EQ(run.state.crowd.arrived, 1) << "13 to 16.6 m from where it waits";
}

TEST(Journeys, AreResumedToTheSameBitsFromAnyStep) {
  const Scene scene = scene_from(everything());
  Trial whole(scene), three(scene, 3);
  whole.steps(1500), three.steps(1500);
  EXPECT_EQ(hash(three.state), hash(whole.state));
  for (const int at : {100, 700, 1100, 1300}) {
    Trial first(scene);
    first.steps(at);
    const std::string file = ::testing::TempDir() + "journeys.ckpt";
    recording::write_checkpoint(file, {"1", "", 0, 0}, first.state);
    Trial second(scene);
    second.state = recording::read_checkpoint(file).state;
    std::remove(file.c_str());
    ASSERT_TRUE(fits(second.state, scene)) << at;
    second.steps(1500 - at);
    EXPECT_EQ(hash(second.state), hash(whole.state)) << at;
    EXPECT_EQ(second.state.crowd, whole.state.crowd) << at;
  }
}

TEST(Journeys, FitOnlyLinesInWhichEachPlaceIsTakenOnce) {
  Trial run(hall("count = 8\nradius = 0.2\ngoal = [{ queue = 'gate' }, 'low']\n"));
  run.steps(1000);
  ASSERT_TRUE(fits(run.state, run.scene));
  std::vector<std::uint32_t>& place = run.state.crowd.place;
  const auto second = std::ranges::find(place, 2u);
  ASSERT_NE(second, place.end());
  *second = 1;
  EXPECT_FALSE(fits(run.state, run.scene));
  *second = 9;
  EXPECT_FALSE(fits(run.state, run.scene));
}

}  // namespace
}  // namespace throng
