// SPDX-License-Identifier: MIT
// Beds that the benchmarks lay side by side.
#include <gtest/gtest.h>

#include "tests/sim/scene_from.h"
#include "tools/bench/scenes.h"

namespace throng::bench {
namespace {

TEST(SideBySide, EachSecondIsAMirrorImage) {
  const Scene one = scene_from(R"(time = { dt = 0.01, until = 1 }
domain = { box = [[1, 0], [4, 5]] }
shapes.ball.disc.radius = { uniform = [0.3, 0.5] }
[[bodies]]
shape = "ball"
at = [1.5, 1]
velocity = [2, 3]
spin = 4
[[bodies]]
shape = "ball"
at = [3, 2]
)");
  const Scene three = side_by_side(one, 3);
  EXPECT_EQ(three.domain.min, one.domain.min);
  EXPECT_EQ(three.domain.max, Vec(10, 5));
  ASSERT_EQ(three.bodies.size(), 6u);
  const std::vector<Vec> places{{1.5, 1}, {6.5, 1}, {7.5, 1}, {3, 2}, {5, 2}, {9, 2}};
  EXPECT_EQ(three.bodies.position, places);
  EXPECT_EQ(three.bodies.velocity[1], Vec(-2, 3));
  EXPECT_EQ(three.bodies.velocity[2], Vec(2, 3));
  EXPECT_EQ(three.bodies.spin[1], -4.0);
  for (std::size_t row = 0; row < 6; ++row) EXPECT_EQ(three.bodies.radius[row], one.bodies.radius[row / 3]);
  EXPECT_EQ(three.bodies.kind.size(), 6u);
}

}  // namespace
}  // namespace throng::bench
