// SPDX-License-Identifier: MIT
#include "sim/simulation.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/sim/scene_from.h"

namespace throng {
namespace {

/// Two discs that rest on each other on the floor, and one beside them that nothing holds.
constexpr const char* kTower = R"(gravity = [0, -10]
time = { dt = 0.01, until = 10, substeps = 3 }
domain = { box = [[0, 0], [9, 9]] }
[materials.default]
density = 2
restitution = 0
[shapes]
ball = { disc = { radius = 0.5 } }
[[bodies]]
shape = "ball"
at = [6, 8.5]
velocity = [0, 60]
[[bodies]]
shape = "ball"
at = [3, 1.5]
[[bodies]]
shape = "ball"
at = [3, 0.5]
)";
constexpr double kWeight = 2.0 * std::numbers::pi * 0.25 * 10.0;  // N, of one

class Simulations : public testing::TestWithParam<const char*> {
 protected:
  /// The rows of the pair, or none.
  static std::vector<ContactRow> rows_of(const std::vector<ContactRow>& rows, std::uint32_t a,
                                         std::uint32_t b) {
    std::vector<ContactRow> found;
    for (const ContactRow& row : rows)
      if (row.a == a && row.b == b) found.push_back(row);
    return found;
  }
};

TEST_P(Simulations, ListWherePressedAndHowHard) {
  const Scene scene = scene_from(std::string("engine = \"") + GetParam() + "\"\n" + kTower);
  const auto run = simulation(scene);
  std::vector<ContactRow> rows;
  run->list_contacts(rows);
  EXPECT_TRUE(rows.empty()) << "nothing has happened yet";
  for (int i = 0; i < 100; ++i) run->step();  // the first disc hits the ceiling, and falls
  run->list_contacts(rows);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(run->contacts(), 2u);
  const auto between = rows_of(rows, 2, 3), floor = rows_of(rows, 3, 0);
  ASSERT_EQ(between.size(), 1u);
  ASSERT_EQ(floor.size(), 1u);
  EXPECT_NEAR(between[0].impulse, kWeight * 0.01, 0.02 * kWeight * 0.01) << "m g h";
  EXPECT_NEAR(floor[0].impulse, 2 * kWeight * 0.01, 0.02 * kWeight * 0.01) << "of both";
  EXPECT_NEAR(between[0].point.x(), 3, 0.02);
  EXPECT_NEAR(between[0].point.y(), 1, 0.02);
  EXPECT_NEAR(floor[0].point.x(), 3, 0.02);
  EXPECT_NEAR(floor[0].point.y(), 0, 0.02);
}

/// Box2D keeps contacts whose discs touch and part: their impulse is 0.
TEST_P(Simulations, ListNoContactThatDoesNotPress) {
  const Scene scene = scene_from(std::string("engine = \"") + GetParam() + "\"\n" + R"(
time = { dt = 0.01, until = 1, substeps = 1 }
[shapes]
ball = { disc = { radius = 0.5 } }
[[bodies]]
shape = "ball"
at = [0, 0]
velocity = [-0.001, 0]
[[bodies]]
shape = "ball"
at = [0.9999, 0]
velocity = [0.001, 0]
)");
  const auto run = simulation(scene);
  std::vector<ContactRow> rows;
  run->step();
  run->list_contacts(rows);
  EXPECT_TRUE(rows.empty()) << rows.at(0).impulse;
  EXPECT_EQ(run->contacts(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Engines, Simulations, testing::Values("native", "box2d"),
                         [](const auto& engine) { return std::string(engine.param); });

}  // namespace
}  // namespace throng
