// SPDX-License-Identifier: MIT
// What agents do on their journeys: wait, line up, choose.
#include "sim/crowd/journeys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/crowd/walk.h"
#include "sim/recording/checkpoint.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// A hall 30 m long: in at its left end, a platform and a gate in the middle, out in the corners of its right
/// end.
std::string hall(const std::string& agents, const std::string& model = "collision_free_speed") {
  return "time = { dt = 0.02, until = 1000 }\nseed = 5\n"
         "walkable = 'POLYGON ((0 0, 30 0, 30 10, 0 10, 0 0))'\n[areas]\n"
         "start = [[0, 2], [4, 2], [4, 8], [0, 8]]\nplatform = [[12, 0], [16, 0], [16, 3], [12, 3]]\n"
         "low = [[29, 0], [30, 0], [30, 2], [29, 2]]\nhigh = [[29, 8], [30, 8], [30, 10], [29, 10]]\n"
         "[queues]\ngate = { line = [[20, 5], [14, 5]], service = 2 }\n"
         "fast = { line = [[20, 8], [17, 8]], service = 0.5 }\n"
         "[[agents]]\ndesired_speed = 1\nplace.random.within = 'start'\nmodel = '" +
         model + "'\n" + agents;
}

/// The steps in which agents got through x = 21, just behind the gates.
std::vector<int> through(Trial& run, int steps) {
  std::vector<int> times;
  std::size_t before = 0;
  for (int i = 1; i <= steps; ++i) {
    run.steps(1);
    const auto now = static_cast<std::size_t>(
        std::ranges::count_if(run.state.crowd.stage, [](std::uint32_t stage) { return stage > 0; }) +
        run.state.crowd.arrived);
    for (std::size_t k = before; k < now; ++k) times.push_back(i);
    before = now;
  }
  return times;
}

TEST(Queue, ServesOneAfterTheOtherInTheOrderInWhichTheyCame) {
  for (const char* model : {"collision_free_speed", "social_force", "orca", "constant_velocity"}) {
    SCOPED_TRACE(model);
    Trial run(hall("count = 8\nradius = 0.2\ngoal = [{ queue = 'gate' }, 'low']\n", model));
    std::vector<std::uint32_t> line, served;
    bool in_order = true;
    for (int i = 0; i < 2200; ++i) {
      run.steps(1);
      std::vector<std::pair<std::uint32_t, std::uint32_t>> now;
      for (std::size_t row = 0; row < run.state.id.size(); ++row)
        if (run.state.crowd.place[row] > 0) now.emplace_back(run.state.crowd.place[row], run.state.id[row]);
      std::ranges::sort(now);
      std::vector<std::uint32_t> ids;
      for (std::size_t k = 0; k < now.size(); ++k) {
        in_order = in_order && now[k].first == k + 1;
        ids.push_back(now[k].second);
      }
      const bool one_left = !line.empty() && (ids.empty() || ids[0] != line[0]);
      if (one_left) served.push_back(line[0]);
      for (std::size_t k = 0; k + one_left < line.size(); ++k)
        in_order = in_order && ids.at(k) == line[k + one_left];
      line = ids;
    }
    EXPECT_TRUE(in_order || std::string(model) == "social_force") << "where nobody is pushed out of it";
    EXPECT_EQ(served.size(), 8u);
    EXPECT_EQ(run.state.crowd.arrived, 8);
  }
}

TEST(Queue, LetsOneThroughEachTimeThatServiceTakes) {
  Trial run(hall("count = 9\nradius = 0.2\ngoal = [{ queue = 'gate' }, 'low']\n"));
  const std::vector<int> times = through(run, 2000);
  ASSERT_EQ(times.size(), 9u);
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (i < 3)
      EXPECT_GE(times[i] - times[i - 1], 100);
    else
      EXPECT_EQ(times[i] - times[i - 1], 100) << "2 s, as the next one stands right behind";
  }
  EXPECT_GE(times[0], 100 + static_cast<int>((20 - 4 - 0.6) / 0.02));
}

TEST(Queue, WaitsForNobodyWhoIsPushedOutOfIt) {
  Trial run(hall("count = 6\nradius = 0.2\ngoal = [{ queue = 'gate' }, 'low']\n"));
  run.steps(1000);
  const auto first = std::ranges::find(run.state.crowd.place, 1u) - run.state.crowd.place.begin();
  const auto in_line = std::ranges::count_if(run.state.crowd.place, [](auto place) { return place > 0; });
  ASSERT_GT(in_line, 3);
  run.state.position[static_cast<std::size_t>(first)] = {17, 9};
  run.steps(1);
  EXPECT_EQ(run.state.crowd.place[static_cast<std::size_t>(first)], in_line) << "its place is the last now";
  run.steps(2000);
  EXPECT_EQ(run.state.crowd.arrived, 6);
}

TEST(Queue, StandsAtItsPlacesAlongTheLine) {
  Trial run(hall("count = 6\nradius = 0.2\ngoal = [{ queue = 'gate' }, 'low']\n"));
  run.scene.crowd.queues[1].service = 1e6;
  Trial slow(run.scene);
  slow.steps(2000);
  std::vector<bool> taken(7, false);
  for (std::size_t row = 0; row < 6; ++row) {
    const std::uint32_t place = slow.state.crowd.place[row];
    ASSERT_TRUE(place >= 1 && place <= 6 && !taken[place]);
    taken[place] = true;
    EXPECT_NEAR(slow.state.position[row].x(), 20 - 0.6 * (place - 1), 0.05);
    EXPECT_NEAR(slow.state.position[row].y(), 5, 0.05);
  }
  EXPECT_TRUE(stuck_agents(slow.scene, slow.state).empty()) << "who stands in line is not stuck";
}

TEST(Queue, LetsWaitBehindItWhomItHasNoPlaceFor) {
  Trial run(hall("count = 20\nradius = 0.2\ngoal = [{ queue = 'fast' }, 'low']\n"));
  std::uint32_t most = 0;
  for (int i = 0; i < 3000; ++i) {
    run.steps(1);
    for (const std::uint32_t place : run.state.crowd.place) most = std::max(most, place);
  }
  EXPECT_EQ(most, 6u) << "3 m with one each 0.6 m";
  EXPECT_EQ(run.state.crowd.arrived, 20);
}

TEST(Queue, LeadsThroughALaneOfRopes) {
  std::string text = hall(
      "count = 12\nradius = 0.2\ngoal = [{ queue = 'gate' }, 'low']\n"
      "[[walls]]\npolyline = [[20.5, 5.4], [14.6, 5.4]]\n"
      "[[walls]]\npolyline = [[20.5, 4.6], [13, 4.6], [13, 8], [14.6, 8]]\n");
  const std::string straight = "[[20, 5], [14, 5]]";
  text.replace(text.find(straight), straight.size(), "[[20, 5], [13.6, 5], [13.6, 7.4], [16, 7.4]]");
  Trial run(text);
  run.steps(3500);
  EXPECT_EQ(run.state.crowd.arrived, 12);
}

TEST(Waiting, StandsApartInTheAreaForItsTime) {
  for (const char* model : {"collision_free_speed", "social_force", "orca"}) {
    SCOPED_TRACE(model);
    Trial run(hall(
        "count = 15\nradius = 0.2\ngoal = [{ wait = 'platform', for = { uniform = [20, 30] } }, 'low']\n",
        model));
    run.steps(1350);
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
          EXPECT_TRUE(waited >= 20 && waited <= 30.02) << waited;
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
    EXPECT_EQ(second.state.crowd.place, whole.state.crowd.place) << at;
    EXPECT_EQ(second.state.crowd.option, whole.state.crowd.option) << at;
    EXPECT_EQ(second.state.crowd.spot, whole.state.crowd.spot) << at;
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
