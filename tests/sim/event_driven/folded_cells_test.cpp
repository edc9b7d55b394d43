// SPDX-License-Identifier: MIT
// Cells of discs, against looking at all of them.
#include "sim/event_driven/folded_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "narrowphase/disc_flight.h"

namespace throng {
namespace {

FoldedCells cells_in(DomainKind kind, const Vec& size, std::size_t discs, double least = 1.0) {
  const Vec low(-3.0, 2.0);
  return {{kind, low, low + size}, {low, low + size}, least, discs};
}

std::multiset<std::uint32_t> listed(const FoldedCells& cells, std::size_t slot) {
  std::vector<std::uint32_t> list{7};
  const std::size_t count = cells.copy(slot, list, 1);
  EXPECT_EQ(list[0], 7u);
  return {list.begin() + 1, list.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(FoldedCells, AreNotManyHoweverThinTheirDomain) {
  for (const Vec& size : {Vec(20, 20), Vec(1e9, 1e-3), Vec(1e-6, 1e9), Vec(4e9, 2e9)})
    for (const std::size_t discs : {1, 100}) {
      const FoldedCells cells = cells_in(DomainKind::box, size, discs, 1e-9);
      EXPECT_LE(cells.slots(), 1e6 + 2.0 * static_cast<double>(discs)) << size.transpose();
      for (const int axis : {0, 1})
        EXPECT_NEAR(static_cast<double>(cells.count(axis)) * cells.edge(axis) / size[axis], 1.0, 1e-9);
    }
}

TEST(FoldedCells, AreAsWideAsTheyMustBeHoweverManyOrFewDiscs) {
  for (const std::size_t discs : {10'000, 1})
    for (const DomainKind kind : {DomainKind::box, DomainKind::periodic, DomainKind::unbounded})
      EXPECT_GE(cells_in(kind, {20, 7}, discs).edge(1), 1.0);
  const FoldedCells nobody(Domain{}, {Vec(0, 0), Vec(0, 0)}, 0.0, 0);
  EXPECT_GT(nobody.edge(0), 0.0);
  EXPECT_EQ(nobody.slots(), 1u);
}

TEST(FoldedCells, AreThreeAtLeastAcrossADomainThatRepeats) {
  const FoldedCells cells = cells_in(DomainKind::periodic, {4, 9}, 1);
  EXPECT_EQ(cells.count(0), 3);
  EXPECT_EQ(cells.count(1), 3);
}

TEST(FoldedCells, KeepTheirListsThroughAnyComingAndGoing) {
  FoldedCells cells = cells_in(DomainKind::box, {2, 1}, 20);
  std::vector<std::multiset<std::uint32_t>> expected(cells.slots());
  std::vector<std::size_t> where(20, 0);
  std::mt19937 random(4);
  std::size_t longest = 0;
  for (std::uint32_t disc = 0; disc < 20; ++disc) cells.add(disc, 0), expected[0].insert(disc);
  for (int i = 0; i < 2000; ++i) {
    const auto disc = static_cast<std::uint32_t>(random() % 20);
    const std::size_t to = random() % cells.slots();
    cells.remove(disc, where[disc]), expected[where[disc]].erase(disc);
    cells.add(disc, to), expected[to].insert(disc);
    where[disc] = to;
    longest = std::max(longest, expected[to].size());
    for (std::size_t slot = 0; slot < cells.slots(); ++slot)
      ASSERT_EQ(listed(cells, slot), expected[slot]) << i;
  }
  EXPECT_GT(longest, 8u) << "more than stand in a cell's own line";
}

TEST(FoldedCells, AreCopiedTogetherAsTheyAreOneByOneWhereNoneIsCrowded) {
  FoldedCells cells = cells_in(DomainKind::box, {9, 7}, 60);
  std::mt19937 random(9);
  std::vector<std::size_t> held(cells.slots(), 0);
  for (std::uint32_t disc = 0; disc < 60; ++disc) {
    const std::size_t slot = random() % cells.slots();
    cells.add(disc, slot), ++held[slot];
  }
  std::size_t crowded = 0, looked = 0;
  for (std::int64_t column = 1; column < cells.count(0) - 1; ++column)
    for (std::int64_t row = 1; row < cells.count(1) - 1; ++row)
      for (const auto& [first, last] : {std::pair{std::array{-1, -1}, std::array{1, 1}},
                                        {std::array{1, -1}, std::array{1, 1}},
                                        {std::array{-1, -1}, std::array{1, -1}}}) {
        std::vector<std::uint32_t> expected, list(FoldedCells::kMostAtOnce);
        std::size_t most = 0;
        cells.for_each_near({{column, row}}, first, last, [&](std::size_t slot, int, int) {
          const auto one = listed(cells, slot);
          expected.insert(expected.end(), one.begin(), one.end());
          most = std::max(most, held[slot]);
        });
        const std::size_t count = cells.copy_near({{column, row}}, first, last, list.data());
        ++looked, crowded += most > 3;
        ASSERT_EQ(count == FoldedCells::kCrowded, most > 3) << column << ", " << row;
        if (count == FoldedCells::kCrowded) continue;
        ASSERT_TRUE(std::is_permutation(expected.begin(), expected.end(), list.begin(),
                                        list.begin() + static_cast<std::ptrdiff_t>(count)));
      }
  EXPECT_GT(crowded, looked / 10);
  EXPECT_LT(crowded, looked / 2);
}

TEST(FoldedCells, AreCopiedTogetherWithinTheRoomThereIsHoweverCrowdedTheyAre) {
  FoldedCells cells = cells_in(DomainKind::box, {5, 5}, 10'000);
  const Cell middle{{1, 1}};
  for (std::uint32_t disc = 0; disc < 10'000; ++disc) cells.add(disc, cells.slot({{disc % 3, disc / 3 % 3}}));
  std::vector<std::uint32_t> list(FoldedCells::kMostAtOnce + 10'000, 77);
  EXPECT_EQ(cells.copy_near(middle, {-1, -1}, {1, 1}, list.data()), FoldedCells::kCrowded);
  EXPECT_EQ(std::count(list.begin() + FoldedCells::kMostAtOnce, list.end(), 77), 10'000);
}

/// Where a cell's middle is, moved by as many tables as it is said to lie away.
Vec middle(const FoldedCells& cells, std::size_t slot, int x, int y) {
  const auto column = static_cast<std::int64_t>(slot) % cells.count(0) + x * cells.count(0);
  const auto row = static_cast<std::int64_t>(slot) / cells.count(0) + y * cells.count(1);
  return {cells.border(0, column) + 0.5 * cells.edge(0), cells.border(1, row) + 0.5 * cells.edge(1)};
}

TEST(FoldedCells, NearACellAreTheNineRoundIt) {
  const FoldedCells cells = cells_in(DomainKind::periodic, {5, 4}, 1000);
  for (std::int64_t row = 0; row < cells.count(1); ++row)
    for (std::int64_t column = 0; column < cells.count(0); ++column) {
      const Cell cell{{column, row}};
      const Vec own = middle(cells, cells.slot(cell), 0, 0);
      std::set<std::pair<int, int>> seen;
      cells.for_each_near(cell, {-1, -1}, {1, 1}, [&](std::size_t slot, int x, int y) {
        const Vec way = middle(cells, slot, x, y) - own;
        const int dx = static_cast<int>(std::lround(way.x() / cells.edge(0)));
        const int dy = static_cast<int>(std::lround(way.y() / cells.edge(1)));
        EXPECT_TRUE(std::abs(dx) <= 1 && std::abs(dy) <= 1) << column << ", " << row;
        EXPECT_TRUE(seen.insert({dx, dy}).second);
      });
      EXPECT_EQ(seen.size(), 9u);
    }
}

TEST(FoldedCells, ListWhatADiscCanTouchFromThere) {
  FoldedCells cells = cells_in(DomainKind::box, {10, 7}, 100);
  Obstacles obstacles;
  obstacles.side = {{{-3, 2}, {1, 0}}, {{7, 9}, {-1, 0}}, {{-3, 2}, {0, 1}}, {{7, 9}, {0, -1}}};
  obstacles.part = {narrowphase::disc(0.3, {1.0, 4.0}), narrowphase::segment({-2.0, 8.0}, {5.0, 3.0})};
  const double reach = 0.5;
  cells.list(obstacles, reach);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = 10 * share(random);
    const Vec at(-3 + x, 2 + 7 * share(random));
    const auto rows = cells.obstacles(cells.slot(cells.cell_of(at)));
    const double gaps[] = {at.x() + 3, 7 - at.x(), at.y() - 2, 9 - at.y()};
    for (std::uint32_t row = 0; row < obstacles.size(); ++row) {
      const double gap = row < 4 ? gaps[row] - reach
                                 : narrowphase::disc_flight(at, reach, {0, 0}, obstacles.part[row - 4]).gap;
      if (gap > 0.0) continue;
      ++touching;
      EXPECT_TRUE(std::ranges::find(rows, row) != rows.end()) << "row " << row << " from " << at.transpose();
    }
  }
  EXPECT_GT(touching, 500);
}

}  // namespace
}  // namespace throng
