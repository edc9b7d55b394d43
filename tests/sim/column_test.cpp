// SPDX-License-Identifier: MIT
#include "sim/column.h"

#include <gtest/gtest.h>

#include "tests/sim/scene_from.h"

namespace throng {
namespace {

/// Boxes 0.5 m wide and 1 m high, at these places.
std::vector<Column> columns_of(std::initializer_list<Vec> places) {
  std::string text =
      "gravity = [0, -9.81]\n[shapes]\nbox = { polygon = [[0, 0], [0.5, 0], [0.5, 1], [0, 1]] }\n";
  for (const Vec& at : places)
    text += "[[bodies]]\nshape = \"box\"\nat = [" + std::to_string(at.x()) + ", " + std::to_string(at.y()) +
            "]\n";
  return columns(scene_from(text));
}

TEST(Columns, OfOneTowerBearAll) {
  const std::vector<Column> all = columns_of({{0, 0.5}, {0, 1.5}, {0, 2.5}});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_DOUBLE_EQ(all[0].load, 3.0);
  EXPECT_DOUBLE_EQ(all[0].layers, 3.0);
  EXPECT_DOUBLE_EQ(all[0].slenderness, 6.0);
  EXPECT_DOUBLE_EQ(all[0].thinnest, 2.0);
  EXPECT_TRUE(all[0].is_tower);
}

TEST(Columns, StandApartWhereNoneIsOverAnother) {
  const std::vector<Column> all = columns_of({{5, 0.5}, {0, 0.5}, {0, 1.5}});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_DOUBLE_EQ(all[0].load, 2.0);
  EXPECT_DOUBLE_EQ(all[1].load, 1.0);
  EXPECT_EQ(all[1].thinnest, 0.0) << "it stands on none";
}

TEST(Columns, SideBySideShareTheirFloor) {
  const std::vector<Column> all =
      columns_of({{0, 0.5}, {0, 1.5}, {0.5, 0.5}, {0.5, 1.5}, {1, 0.5}, {1, 1.5}, {1.5, 0.5}, {1.5, 1.5}});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_DOUBLE_EQ(all[0].load, 4.0) << "twice the mean";
  EXPECT_DOUBLE_EQ(all[0].slenderness, 1.0);
  EXPECT_FALSE(all[0].is_tower);
}

}  // namespace
}  // namespace throng
