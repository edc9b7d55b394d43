// SPDX-License-Identifier: MIT
#include "sim/contact/solver_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/contact/pressed.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// Discs in two layers whose rows go to and fro between left and right.
const char* const kLayers =
    "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\n"
    "domain = { box = [[0, 0], [5000, 99]] }\n[shapes]\nball = { disc = { radius = 0.5 } }\n"
    "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [1, 0.5], spacing = [1.1, 1], size = [4100, "
    "2] } }\n";

/// Where those of a part stand: from the first to behind the last.
std::pair<std::uint32_t, std::uint32_t> places(const Trial& run, std::size_t part) {
  std::uint32_t first = ~0u, last = 0;
  for (std::uint32_t row = 0; row < run.scene.bodies.size(); ++row)
    if (run.work.finder.parts().group(row) == part) {
      first = std::min(first, run.work.bodies.rows().place(row));
      last = std::max(last, run.work.bodies.rows().place(row));
    }
  return {first, last + 1};
}

TEST(SolverBodies, StandWithThoseOfTheirPart) {
  Trial run(kLayers);
  const Parts& parts = run.work.finder.parts();
  ASSERT_EQ(parts.count(), 2u);
  for (std::uint32_t row = 0; row < run.work.bodies.size(); ++row)
    EXPECT_EQ(run.work.bodies.rows().place(row), row) << "before the first step";
  run.steps(1);
  EXPECT_EQ(places(run, 0).first, 0u);
  EXPECT_LE(places(run, 0).second, places(run, 1).first);
  for (std::uint32_t row = 0; row < run.scene.bodies.size(); ++row)
    EXPECT_EQ(run.work.bodies[row].position, run.state.position[row]) << row;
  const std::size_t n = run.scene.bodies.size();
  EXPECT_EQ(run.work.bodies.rows().place(n), places(run, 0).second) << "what stands for the floor";
  EXPECT_EQ(run.work.bodies.rows().place(n + 1), places(run, 1).second);
}

TEST(SolverBodies, MoveWhenManyAreAstray) {
  Trial run(kLayers);
  run.steps(1);
  Parts parts = run.work.finder.parts();
  State state = run.state;
  const auto send_left = [&](std::size_t n) {
    for (std::size_t row = 8199; n > 0; --row)
      if (state.position[row].x() > 3000.0) state.position[row].x() -= 2500.0, --n;
    return parts.place(state, Rows::all(state.position.size()));
  };
  ASSERT_TRUE(send_left(100));
  EXPECT_FALSE(run.work.bodies.arrange(parts)) << "few";
  ASSERT_TRUE(send_left(200));
  EXPECT_TRUE(run.work.bodies.arrange(parts));
  EXPECT_FALSE(run.work.bodies.arrange(parts)) << "again";
  std::vector<std::uint32_t> taken(run.work.bodies.rows().places().begin(),
                                   run.work.bodies.rows().places().end());
  std::ranges::sort(taken);
  for (std::uint32_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i], i);
  for (std::uint32_t row = 0; row < state.position.size(); ++row)
    EXPECT_EQ(run.work.bodies[row].position, run.state.position[row]) << row;
}

TEST(Pressed, IsOneOfThemAll) {
  Trial run(
      "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\n" + std::string(kDisc) +
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
    EXPECT_EQ(is_pressed(run.state, colliders, body), pressed[body] != 0) << body;
  EXPECT_FALSE(is_pressed(run.state, colliders, 3)) << "still falls";
}

}  // namespace
}  // namespace throng
