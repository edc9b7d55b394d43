// SPDX-License-Identifier: MIT
// Agents line up, one behind the other, and are served.
#include "sim/crowd/queues.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/crowd/stuck.h"
#include "sim/crowd/walk.h"
#include "tests/sim/crowd/hall.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

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
    EXPECT_TRUE(in_order);
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

/// Lets one agent of each model walk from `start` past those walls to the queue, and through it.
void expect_arrival(const Vec& start, const std::string& walls) {
  for (const char* model : {"collision_free_speed", "social_force", "orca", "constant_velocity"}) {
    SCOPED_TRACE(model);
    Trial run(hall("count = 1\nradius = 0.2\ngoal = [{ queue = 'gate' }, 'high']\n" + walls, model));
    run.state.position[0] = start;
    run.steps(2200);
    EXPECT_EQ(run.state.crowd.arrived, 1);
  }
}

// He stood before the rope for ever: so near to the line, he was sent straight to its end.
TEST(Queue, IsFoundRoundARopeBesideIt) {
  expect_arrival({22, 4.4}, "[[walls]]\nsegment = [[13.4, 4.7], [30, 4.7]]\n");
}

// He was sent through the gap, through which he saw the end of the queue.
TEST(Queue, IsNotWalkedToThroughAGapNarrowerThanAnAgent) {
  expect_arrival({11, 5},
                 "[[walls]]\nsegment = [[13, 1], [13, 4.85]]\n[[walls]]\nsegment = [[13, 5.15], [13, 10]]\n");
}

TEST(Queue, ForgetsWhoCannotGetBackToHisPlaceAndSaysThatHeIsStuck) {
  for (const int count : {1, 4}) {
    Trial run(hall("count = " + std::to_string(count) +
                   "\nradius = 0.2\ngoal = [{ queue = 'gate' }, 'low']\n"
                   "[[walls]]\npolygon = [[25, 2], [27, 2], [27, 4], [25, 4]]\n"));
    run.scene.crowd.queues[1].service = 60;
    Trial slow(run.scene);
    slow.steps(1200);
    const auto last = std::ranges::find(slow.state.crowd.place, static_cast<std::uint32_t>(count));
    ASSERT_NE(last, slow.state.crowd.place.end());
    slow.state.position[static_cast<std::size_t>(last - slow.state.crowd.place.begin())] = {26, 3};
    slow.steps(600);
    EXPECT_EQ(*last, 0u);
    EXPECT_EQ(stuck_agents(slow.scene, slow.state).size(), 1u);
  }
}

// The clock began anew at each change of places, and nobody was ever served.
TEST(Queue, ServesHimToTheEndWhoIsServedHoweverOthersPush) {
  Trial run(hall("count = 2\nradius = 0.2\ngoal = [{ queue = 'gate' }, 'low']\n"));
  run.scene.crowd.queues[1].service = 5;
  Trial two(run.scene);
  while (std::ranges::count(two.state.crowd.place, 0u) > 0) two.steps(1);
  const std::int64_t from = two.state.step;
  while (two.state.step < from + 600 && two.state.crowd.stage[0] + two.state.crowd.stage[1] < 2) {
    for (const std::size_t row : {0u, 1u}) {
      const bool is_nearer = (two.state.step % 2 == 0) == (row == 0);
      if (two.state.crowd.stage[row] == 0) two.state.position[row] = {19.7, is_nearer ? 5.01 : 5.011};
    }
    two.steps(1);
  }
  EXPECT_EQ(two.state.crowd.stage[0] + two.state.crowd.stage[1], 2u);
}

TEST(Queue, ThatIsFullKeepsNobodyStuck) {
  Trial run(hall("count = 20\nradius = 0.2\ngoal = [{ queue = 'fast' }, 'low']\n"));
  run.scene.crowd.queues[0].service = 1e9;
  Trial slow(run.scene);
  slow.steps(3000);
  EXPECT_EQ(std::ranges::count(slow.state.crowd.place, 0u), 14);
  EXPECT_TRUE(stuck_agents(slow.scene, slow.state).empty()) << "they wait for a place";
  EXPECT_EQ(slow.state.crowd.arrived, 0) << "a service of 1e9 s, counted in steps";
}

// They turned this way and that after 10 s, as if an arch held them; later the last in the line was pushed to
// and fro by those behind him, 1.2 m in 10 s.
TEST(Queue, ThatIsFullLetsThoseBehindItStandStill) {
  for (const char* model : {"collision_free_speed", "social_force", "orca"}) {
    SCOPED_TRACE(model);
    Trial run(hall("count = 20\nradius = 0.2\ngoal = [{ queue = 'fast' }, 'low']\n", model));
    run.scene.crowd.queues[0].service = 1e9;
    Trial slow(run.scene);
    slow.steps(3000);
    const std::vector<Vec> before = slow.state.position;
    std::vector<double> way(before.size(), 0.0);
    for (int i = 0; i < 500; ++i) {
      slow.steps(1);
      for (std::size_t row = 0; row < way.size(); ++row) way[row] += 0.02 * slow.state.velocity[row].norm();
    }
    for (std::size_t row = 0; row < way.size(); ++row)
      EXPECT_LT(way[row], 0.1) << "m in 10 s, agent " << slow.state.id[row] << ", place "
                               << slow.state.crowd.place[row];
  }
}

}  // namespace
}  // namespace throng
