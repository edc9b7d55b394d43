// SPDX-License-Identifier: MIT
#include "broadphase/cells.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

Cells cells_of(const Point& high, double size, std::size_t items, const Period* period = nullptr) {
  Cells cells;
  cells.fit({0.0, 0.0}, high, size, items, period);
  return cells;
}

TEST(Cells, NeedATableInProportionToTheItemsHoweverLargeTheArea) {
  for (const double side : {1.0, 30.0, 1e3, 1e9, 1e150}) {
    for (const std::size_t items : {0u, 1u, 100u, 10000u}) {
      const Cells cells = cells_of({side, 0.3 * side}, 1.0, items);
      EXPECT_LE(cells.buckets(), 4 * items + 64) << side << ", " << items;
      EXPECT_LT(cells.bucket(cells.cell({side, 0.3 * side})), cells.buckets());
    }
  }
}

TEST(Cells, HaveBucketsOfTheirOwnWhereThereAreEnough) {
  const Cells cells = cells_of({9.5, 19.5}, 1.0, 50);
  ASSERT_FALSE(cells.shared());
  std::set<std::size_t> buckets;
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 20; ++y) buckets.insert(cells.bucket(cells.cell({x + 0.5, y + 0.5})));
  EXPECT_EQ(buckets.size(), 200u);
}

// Points in step with the table would all fall into one bucket if the place in the row alone decided.
TEST(Cells, AreSpreadOverTheTableWhateverTheStepBetweenThem) {
  const std::size_t items = 1024;
  const Cells cells = cells_of({1e7, 1e7}, 1.0, items);
  ASSERT_TRUE(cells.shared());
  for (const std::int64_t step : {1, 3, 64, 1023, 1024, 2048, 4096}) {
    for (const Cell& by : {Cell{step, 0}, Cell{0, step}, Cell{step, step}}) {
      std::vector<int> load(cells.buckets(), 0);
      for (std::int64_t i = 0; i < 1024; ++i) ++load[cells.bucket({i * by.x, i * by.y})];
      EXPECT_LE(*std::max_element(load.begin(), load.end()), 10) << by.x << ", " << by.y;
    }
  }
}

TEST(Cells, OfARangeComeInRunsThatCoverEachCellOnce) {
  const Period period{{0, 0}, {10, 10}};
  for (const std::size_t items : {1u, 1000u}) {  // shared and not
    for (const Period* p : {static_cast<const Period*>(nullptr), &period}) {
      const Cells cells = cells_of({10, 10}, 0.7, items, p);
      Range range;
      ASSERT_TRUE(cells.range({0.3, 9.9}, 2.0, range));
      std::set<std::pair<std::int64_t, std::int64_t>> visited;
      cells.for_each_run(range, [&](const broadphase::Run& run) {
        EXPECT_EQ(run.end_bucket - run.bucket, static_cast<std::size_t>(run.last_x - run.first.x) + 1);
        for (std::int64_t x = run.first.x; x <= run.last_x; ++x) {
          EXPECT_TRUE(visited.insert({x, run.first.y}).second);
          EXPECT_EQ(cells.bucket({x, run.first.y}), run.bucket + static_cast<std::size_t>(x - run.first.x));
        }
      });
      EXPECT_EQ(static_cast<double>(visited.size()), range.count());
      EXPECT_EQ(visited.contains({cells.columns() - 1, 0}), p != nullptr);  // round both seams
    }
  }
}

}  // namespace
}  // namespace throng::broadphase
