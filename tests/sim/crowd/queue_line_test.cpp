// SPDX-License-Identifier: MIT
#include "sim/crowd/queue_line.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

/// 3 m to the left, then 2 m up.
QueueLine corner() {
  return QueueLine(Queue{.name = "q", .line = {{0, 0}, {-3, 0}, {-3, 2}}, .spacing = 0.5});
}

TEST(QueueLine, HasItsPlacesAlongIt) {
  const QueueLine line = corner();
  EXPECT_EQ(line.places(), 11u) << "one at each end, and nine between";
  EXPECT_EQ(line.place(1), Vec(0, 0));
  EXPECT_EQ(line.place(2), Vec(-0.5, 0));
  EXPECT_EQ(line.place(7), Vec(-3, 0));
  EXPECT_EQ(line.place(8), Vec(-3, 0.5));
  EXPECT_EQ(line.place(11), Vec(-3, 2));
  EXPECT_EQ(line.place(12), Vec(-3, 2)) << "behind the last one";
  const std::vector<Vec> all = line.all_places();
  ASSERT_EQ(all.size(), 11u);
  for (std::uint32_t number = 1; number <= 11; ++number) EXPECT_EQ(all[number - 1], line.place(number));
  EXPECT_EQ(QueueLine(Queue{.name = "q", .line = {{0, 0}, {6, 0}}, .spacing = 0.6}).places(), 11u);
}

TEST(QueueLine, IsAsFarAsItsNearestPoint) {
  EXPECT_DOUBLE_EQ(corner().distance({-1, -2}), 2.0);
  EXPECT_DOUBLE_EQ(corner().distance({-4, 1}), 1.0);
  EXPECT_DOUBLE_EQ(corner().distance({3, 4}), 5.0);
}

TEST(QueueLine, KnowsTheNextBendOnTheWay) {
  const QueueLine line = corner();
  EXPECT_EQ(line.bend({-1, 0.1}, 11), Vec(-3, 0)) << "up the line";
  EXPECT_EQ(line.bend({-3, 1.8}, 1), Vec(-3, 0)) << "down the line";
  EXPECT_EQ(line.bend({-3, 0.05}, 1), std::nullopt) << "is there";
  EXPECT_EQ(line.bend({-1, 0}, 5), std::nullopt) << "straight on";
}

}  // namespace
}  // namespace throng
