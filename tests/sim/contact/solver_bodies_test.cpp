// SPDX-License-Identifier: MIT
#include "sim/contact/solver_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/contact/list_contacts.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// Discs in two layers whose rows go to and fro between left and right.
const char* const kLayers =
    "gravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\nsleep = false\n"
    "domain = { box = [[0, 0], [5000, 99]] }\n[shapes]\nball = { disc = { radius = 0.5 } }\n"
    "[[bodies]]\nshape = \"ball\"\nplace = { lattice = { origin = [1, 0.5], spacing = [1.1, 1], size = "
    "[4100, "
    "2] } }\n";

std::uint32_t slot(const Trial& run, std::size_t row) {
  return run.work.bodies.rows().slots().slot(static_cast<std::uint32_t>(row));
}

/// Where those of a part stand: from the first to behind the last.
std::pair<std::uint32_t, std::uint32_t> slots(const Trial& run, std::size_t part) {
  std::uint32_t first = ~0u, last = 0;
  for (std::uint32_t row = 0; row < run.scene.bodies.size(); ++row)
    if (run.work.finder.parts().group(row) == part)
      first = std::min(first, slot(run, row)), last = std::max(last, slot(run, row));
  return {first, last + 1};
}

TEST(SolverBodies, StandWithThoseOfTheirPart) {
  Trial run(kLayers);
  ASSERT_EQ(run.work.finder.parts().count(), 2u);
  for (std::uint32_t row = 0; row < run.work.bodies.size(); ++row)
    EXPECT_EQ(slot(run, row), row) << "before the first step";
  run.steps(1);
  EXPECT_EQ(slots(run, 0).first, 0u);
  EXPECT_LE(slots(run, 0).second, slots(run, 1).first);
  for (std::uint32_t row = 0; row < run.scene.bodies.size(); ++row)
    EXPECT_EQ(run.work.bodies[row].position, run.state.position[row]) << row;
  const std::size_t n = run.scene.bodies.size();
  EXPECT_EQ(slot(run, n), slots(run, 0).second) << "what stands for the floor";
  EXPECT_EQ(slot(run, n + 1), slots(run, 1).second);
}

TEST(SolverBodies, ContactsTellTheirRows) {
  Trial run(kLayers);
  run.steps(3);
  ASSERT_NE(slot(run, 5000), 5000u);
  std::vector<ContactRow> rows;
  list_contacts(run.scene, run.work.contacts, nullptr, run.state, run.work.bodies, rows);
  EXPECT_GT(rows.size(), 8000u);
  for (const ContactRow& row : rows) {
    EXPECT_NEAR((row.point - run.state.position[row.a - 1]).norm(), 0.5, 1e-3) << row.a << " and " << row.b;
    if (row.b == 0) continue;
    EXPECT_NEAR((row.point - run.state.position[row.b - 1]).norm(), 0.5, 1e-3) << row.a;
  }
  for (std::size_t i = 0; i < run.work.contacts.discs.size(); ++i) {
    const BlockContact contact = run.work.contacts.discs.contact(i);
    EXPECT_NEAR((run.state.position[contact.a] - run.state.position[contact.b]).norm(), 1.0, 0.2) << i;
  }
}

TEST(SolverBodies, MoveWhenManyAreAstray) {
  Trial run(kLayers);
  run.steps(1);
  Parts parts = run.work.finder.parts();
  State state = run.state;
  const auto send_left = [&](std::size_t n) {
    for (std::size_t row = 8199; n > 0; --row)
      if (state.position[row].x() > 3000.0) state.position[row].x() -= 2500.0, --n;
    parts.place(state, Rows::all(state.position.size()));
    run.work.bodies.arrange(parts);
  };
  const std::uint32_t before = slot(run, 8199);
  send_left(100);
  EXPECT_EQ(slot(run, 8199), before) << "few";
  send_left(200);
  EXPECT_LT(slot(run, 8199), before);
  std::vector<std::uint32_t> taken;
  for (std::uint32_t row = 0; row < run.work.bodies.size(); ++row) {
    taken.push_back(slot(run, row));
    EXPECT_EQ(run.work.bodies.rows().slots().row(taken.back()), row);
  }
  std::ranges::sort(taken);
  for (std::uint32_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i], i);
  for (std::uint32_t row = 0; row < state.position.size(); ++row)
    EXPECT_EQ(run.work.bodies[row].position, run.state.position[row]) << row;
}

}  // namespace
}  // namespace throng
