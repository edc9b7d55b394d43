// SPDX-License-Identifier: MIT
#include "sim/contact/pressed.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim/trial.h"

namespace throng {
namespace {

TEST(Pressed, AreTwoWhereBothAreAmongThem) {
  Trial run("gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\n" + std::string(kDisc) +
            "box = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n"
            "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n"
            "[[bodies]]\nshape = \"box\"\nat = [0, 0.5]\n[[bodies]]\nshape = \"box\"\nat = [0, 1.5]\n"
            "[[bodies]]\nshape = \"ball\"\nat = [0, 2.5]\n[[bodies]]\nshape = \"ball\"\nat = [3, 8]\n"
            "[[bodies]]\nshape = \"ball\"\nat = [5, 0.5]\n[[bodies]]\nshape = \"ball\"\nat = [5, 1.5]\n");
  run.steps(20);
  const Colliders& colliders = run.work.candidates.colliders();
  std::vector<std::uint8_t> pressed;
  find_pressed(run.state, colliders, pressed);
  EXPECT_EQ(std::ranges::count(pressed, 1), 5);
  for (std::uint32_t body = 0; body < pressed.size(); ++body)
    for (std::uint32_t other = 0; other < pressed.size(); ++other)
      EXPECT_EQ(are_pressed(run.state, colliders, body, other), pressed[body] && pressed[other])
          << body << ", " << other;
  EXPECT_FALSE(pressed[3]) << "still falls";
}

}  // namespace
}  // namespace throng
