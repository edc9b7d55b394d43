// SPDX-License-Identifier: MIT
// Rows of large crowds follow where agents stand; nothing else may follow from it.
#include "sim/crowd/row_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim/trial.h"

namespace throng {
namespace {

/// Two streams that cross, so many on so much floor that some stand in one cell; the first leave at once.
Scene streams(std::size_t agents) {
  const std::string side = std::to_string(std::sqrt(1.2 * static_cast<double>(agents)));
  const std::string half = std::to_string(agents / 2);
  std::string text = "time = { dt = 0.05, until = 100 }\nseed = 3\ndomain.box = [[0, 0], [" + side + ", " +
                     side + "]]\nareas.right = [[3, 0], [" + side + ", 0], [" + side +
                     ", 3], [3, 3]]\nareas.above = [[0, " + "3], [3, 3], [3, " + side + "], [0, " + side +
                     "]]\n";
  for (const char* goal : {"right", "above"})
    text += "[[agents]]\ncount = " + half + "\nplace.random.within = [[0, 0], [" + side + ", " + side +
            "]]\nmodel = 'collision_free_speed'\ncollision_free_speed.cutoff = 1\ngoal = '" + goal + "'\n";
  return scene_from(text);
}

const Scene& large() {
  static const Scene scene = streams(kMany);
  return scene;
}

/// A state of so many agents, each of whose numbers tells who it is.
State numbered(std::uint32_t agents) {
  State state;
  for (std::uint32_t i = 0; i < agents; ++i) {
    const double x = i;
    state.id.push_back(i + 1), state.position.push_back({x, x}), state.velocity.push_back({x, x});
    state.angle.push_back(x), state.spin.push_back(x);
    CrowdState& crowd = state.crowd;
    crowd.stand.push_back({x, x}), crowd.stand_step.push_back(i), crowd.stage.push_back(i);
    crowd.option.push_back(i), crowd.place.push_back(i), crowd.since.push_back(i),
        crowd.spot.push_back({x, x}), crowd.halt.push_back({x, x}), crowd.halt_step.push_back(i);
  }
  return state;
}

void expect_rows(const State& state, const std::vector<std::uint32_t>& ids) {
  EXPECT_EQ(state.id, ids);
  for_each_agent_array(state.crowd, [&](const auto& all) { EXPECT_EQ(all.size(), ids.size()); });
  for (std::size_t row = 0; row < ids.size(); ++row) {
    const double x = ids[row] - 1.0;
    EXPECT_TRUE(state.position[row].x() == x && state.velocity[row].y() == x && state.angle[row] == x &&
                state.spin[row] == x)
        << row;
    const CrowdState& crowd = state.crowd;
    EXPECT_TRUE(crowd.stand[row].x() == x && crowd.stand_step[row] == x && crowd.stage[row] == x &&
                crowd.option[row] == x && crowd.place[row] == x && crowd.since[row] == x &&
                crowd.spot[row].y() == x && crowd.halt[row].y() == x && crowd.halt_step[row] == x)
        << row;
  }
}

TEST(RowOrder, MovesAllThatIsKnownOfAnAgent) {
  Workers workers(1);
  State state = numbered(4);
  reorder_agents(state, 0, std::vector<std::uint32_t>{2, 0, 3, 1}, workers);
  expect_rows(state, {3, 1, 4, 2});
}

TEST(RowOrder, TakesOutWhoLeaves) {
  using Leaves = std::vector<std::uint8_t>;
  const auto left = [](const Leaves& leaves, bool in_order) {
    State state = numbered(static_cast<std::uint32_t>(leaves.size()));
    remove_agents(state, 0, leaves, in_order);
    return state;
  };
  expect_rows(left({0, 1, 0, 0, 1, 0}, true), {1, 3, 4, 6});
  expect_rows(left({0, 1, 0, 0, 1, 0}, false), {1, 6, 3, 4});
  expect_rows(left({1, 0, 0, 1, 1}, false), {3, 2});
  expect_rows(left({0, 0, 1, 1}, false), {1, 2});
  expect_rows(left({1, 1}, false), {});
  expect_rows(left({0, 1}, false), {1});
}

TEST(RowOrder, FollowsWhereAgentsStandInLargeCrowds) {
  Trial run(large());
  const auto apart = [&] {  // m, of those whose rows follow one another
    double sum = 0.0;
    for (std::size_t row = 1; row < run.state.id.size(); ++row)
      sum += (run.state.position[row] - run.state.position[row - 1]).norm();
    return sum / static_cast<double>(run.state.id.size());
  };
  EXPECT_GT(apart(), 30.0);
  run.steps(1);
  EXPECT_LT(apart(), 10.0);
}

TEST(RowOrder, FollowsInSmallerCrowdsWhereNothingElseDoes) {
  EXPECT_FALSE(rows_follow(streams(kSome - 2).crowd));
  const Scene plain = streams(kSome);
  EXPECT_TRUE(rows_follow(plain.crowd));
  const auto follow = [&](auto change) {
    Crowd crowd = plain.crowd;
    change(crowd);
    return rows_follow(crowd);
  };
  EXPECT_FALSE(follow([](Crowd& crowd) { crowd.measures.emplace_back(); }));
  EXPECT_FALSE(follow([](Crowd& crowd) { crowd.goals[1].phases.emplace_back(); }));
  EXPECT_FALSE(follow([](Crowd& crowd) { crowd.groups[1].journey[0].kind = Leg::Kind::wait; }));
  EXPECT_FALSE(follow([](Crowd& crowd) { crowd.groups[1].journey[0].kind = Leg::Kind::queue; }));
  EXPECT_FALSE(follow([](Crowd& crowd) { crowd.groups[0].journey[0].capacity = {1.0}; }));
  EXPECT_FALSE(follow([](Crowd& crowd) { crowd.groups[0].entrance.emplace(); }));
  Crowd many = large().crowd;
  many.measures.emplace_back();
  EXPECT_TRUE(rows_follow(many));
}

// A measure keeps the rows of the one as they are.
TEST(RowOrder, TakesNobodyElsewhere) {
  const Scene plain = streams(kSome);
  Scene measured = plain;
  measured.crowd.measures.emplace_back().line = {Vec(1, 0), Vec(1, 3)};
  Trial follows(plain), stays(measured);
  follows.steps(150), stays.steps(150);
  EXPECT_TRUE(std::ranges::is_sorted(stays.state.id));
  EXPECT_FALSE(std::ranges::is_sorted(follows.state.id));
  ASSERT_EQ(follows.state.id.size(), stays.state.id.size());
  EXPECT_LT(stays.state.id.size(), kSome);
  std::vector<std::size_t> row(kSome + 1);
  for (std::size_t i = 0; i < follows.state.id.size(); ++i) row[follows.state.id[i]] = i;
  for (std::size_t i = 0; i < stays.state.id.size(); ++i)
    ASSERT_EQ(follows.state.position[row[stays.state.id[i]]], stays.state.position[i]) << stays.state.id[i];
}

// A small crowd's rows stay as they are: what happens there must not depend on it.
TEST(RowOrder, ChangesNothingElse) {
  Trial run(large()), shuffled(large()), three(large(), 3);
  Workers workers(1);
  for (int i = 0; i < 70; ++i) {
    run.steps(1), three.steps(1);
    if (i == 30) {  // by id, as if rows had never moved
      std::vector<std::uint32_t> order(shuffled.state.id.size());
      for (std::uint32_t row = 0; row < order.size(); ++row) order[row] = row;
      std::ranges::sort(order, {}, [&](std::uint32_t row) { return shuffled.state.id[row]; });
      reorder_agents(shuffled.state, 0, order, workers);
    }
    shuffled.steps(1);
  }
  EXPECT_GT(run.state.crowd.arrived, 100);
  EXPECT_EQ(hash(shuffled.state), hash(run.state));
  EXPECT_EQ(hash(three.state), hash(run.state));
}

}  // namespace
}  // namespace throng
