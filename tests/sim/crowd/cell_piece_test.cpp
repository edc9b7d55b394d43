// SPDX-License-Identifier: MIT
#include "sim/crowd/cell_piece.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "sim/random.h"
#include "tests/less_when_watched.h"
#include "tools/bench/geodesic.h"

namespace throng {
namespace {

using bench::rectangle;

const std::vector<Vec> kSquare{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

void expect_sizes(const Region& floor, const Region& area, const Vec& agent, double whole, double in_area) {
  CellPiece piece(floor, area);
  const auto found = piece.sizes(kSquare, agent);
  EXPECT_NEAR(found.whole, whole, 1e-12);
  EXPECT_NEAR(found.in_area, in_area, 1e-12);
}

TEST(CellPiece, ByHand) {
  const Region hall{{rectangle(0, 0, 10, 10)}}, left{{rectangle(0, 0, 5, 10)}};
  expect_sizes(hall, left, {2, 5}, 4.0, 4.0);
  expect_sizes(hall, left, {8, 5}, 4.0, 0.0);
  expect_sizes(hall, left, {5.5, 5}, 4.0, 1.0);
  expect_sizes(hall, left, {0.25, 0.5}, 1.25 * 1.5, 1.25 * 1.5);
  expect_sizes(hall, {{rectangle(4, 4, 4.5, 4.5)}}, {4.2, 4.2}, 4.0, 0.25);
  const Region frame{{rectangle(0, 0, 10, 10), rectangle(5, 4, 5.5, 6)}};
  expect_sizes(frame, left, {4.75, 5}, 1.25 * 2.0, 1.25 * 2.0);
  expect_sizes(frame, left, {4.75, 5.5}, 4.0 - 0.5 * 1.5, 1.25 * 2.0);
}

TEST(CellPiece, ThatIsBehindAWallIsAnothers) {
  // two rooms with 0.2 m between; one with a door at the top
  const Region shut{{rectangle(0, 0, 4.9, 10), rectangle(5.1, 0, 10, 10)}}, all{{rectangle(0, 0, 10, 10)}};
  expect_sizes(shut, shut, {4.5, 5}, 1.4 * 2.0, 1.4 * 2.0);
  expect_sizes(shut, shut, {5.5, 5}, 1.4 * 2.0, 1.4 * 2.0);
  const Region door{{rectangle(0, 0, 10, 10), rectangle(4.9, 1, 5.1, 5.5)}};
  expect_sizes(door, all, {4.5, 5}, 4.0 - 0.2 * 1.5, 4.0 - 0.2 * 1.5);
  expect_sizes(door, all, {4.5, 3}, 1.4 * 2.0, 1.4 * 2.0);
}

// A hole that touches the floor's edge, or another hole, in a corner: which ring is a hole was told by that
// corner alone.
TEST(CellPiece, OfHolesThatTouchInACorner) {
  const Region tips{
      {rectangle(0, 0, 10, 10), {{5, 0}, {6, 1}, {5, 2}, {4, 1}}, {{5, 2}, {6, 3}, {5, 4}, {4, 3}}}};
  const Region all{{rectangle(0, 0, 10, 10)}};
  expect_sizes(tips, all, {4, 2}, 4.0 - 1.0, 4.0 - 1.0);
  expect_sizes(tips, all, {8, 1}, 4.0, 4.0);
}

/// m², of the points of a fine grid in the cell that are connected on the floor, and of those in the area.
CellPiece::Sizes by_points(const Inside& floor, const Inside& area, const Vec& agent, double h) {
  const int n = static_cast<int>(1.0 / h);
  const auto row = [&](int i, int k) { return static_cast<std::size_t>((k + n) * (2 * n + 1) + i + n); };
  std::vector<bool> seen(static_cast<std::size_t>((2 * n + 1) * (2 * n + 1)), false);
  std::deque<std::pair<int, int>> next{{0, 0}};
  seen[row(0, 0)] = true;
  CellPiece::Sizes sizes{0.0, 0.0};
  while (!next.empty()) {
    const auto [i, k] = next.front();
    next.pop_front();
    const Vec p = agent + h * Vec(i, k);
    sizes.whole += h * h, sizes.in_area += area(p) ? h * h : 0.0;
    for (const auto& [x, y] : {std::pair{i + 1, k}, {i - 1, k}, {i, k + 1}, {i, k - 1}}) {
      if (std::abs(x) > n || std::abs(y) > n || seen[row(x, y)]) continue;
      seen[row(x, y)] = true;
      if (floor(agent + h * Vec(x, y))) next.emplace_back(x, y);
    }
  }
  return sizes;
}

TEST(CellPiece, AgreesWithManyPoints) {
  Region floor{{rectangle(0, 0, 10, 10)}};
  for (const int k : {2, 5}) floor.rings.push_back(rectangle(0.5, 1.05 + k * 1.05, 9.5, 1.15 + k * 1.05));
  for (int i = 0; i < 8; ++i)  // slanted walls of 0.15 m, some of which nearly meet
    for (int k = 0; k < 8; ++k) {
      if (k == 2 || k == 5) continue;
      const Vec at(1.1 + i * 1.05, 1.1 + k * 1.05);
      const double turn = 0.7 * i + 1.3 * k;
      const Vec along(0.5 * std::cos(turn), 0.5 * std::sin(turn)), up(-0.136 * along.y(), 0.136 * along.x());
      floor.rings.push_back({at - along - up, at + along - up, at + along + up, at - along + up});
    }
  const Region area{{{{3, -1}, {7, -1}, {5.5, 11}, {4, 11}}}};
  const Inside is_floor(floor), is_area(area);
  CellPiece piece(floor, area);
  Random random(7, 0, 1, Purpose::place);
  int split = 0, parts = 0;
  const int many = static_cast<int>(less_when_watched(40));
  for (int asked = 0; asked < many;) {
    const double x = random.uniform(1.5, 8.5);
    const Vec agent(x, random.uniform(1.5, 8.5));
    if (!contains(floor, agent)) continue;
    ++asked;
    const auto found = piece.sizes(kSquare, agent);
    const auto truth = by_points(is_floor, is_area, agent, 0.004);
    EXPECT_NEAR(found.whole, truth.whole, 0.05) << agent.transpose();
    EXPECT_NEAR(found.in_area, truth.in_area, 0.05) << agent.transpose();
    split += found.whole<2.8, parts += found.in_area> 0.0 && found.in_area < found.whole;
  }
  EXPECT_GT(parts, many / 4);
  EXPECT_GT(split, many / 11);
}

}  // namespace
}  // namespace throng
