// SPDX-License-Identifier: MIT
#include "sim/event_driven/soonest.h"

#include <gtest/gtest.h>

#include <random>

namespace throng {
namespace {

TEST(Soonest, OfEqualTimesTheLowestRow) {
  Soonest soonest(5);
  EXPECT_EQ(soonest.time(), Soonest::kNever);
  soonest.set(4, 2.0), soonest.set(3, 2.0), soonest.set(1, 3.0);
  EXPECT_EQ(soonest.rows().row, 3u);
  soonest.set(3, 5.0);
  EXPECT_EQ(soonest.rows().row, 4u);
  EXPECT_EQ(soonest.time(), 2.0);
}

TEST(Soonest, AgreesWithLookingAtAllRows) {
  std::mt19937 random(3);
  for (const std::size_t rows : {1, 2, 3, 64, 1000}) {
    Soonest soonest(rows);
    std::vector<double> times(rows, Soonest::kNever);
    for (int i = 0; i < 3000; ++i) {
      const auto row = static_cast<std::uint32_t>(random() % rows);
      times[row] = random() % 7 == 0 ? Soonest::kNever : static_cast<double>(random() % 100);
      soonest.set(row, times[row]);
      const auto least = std::ranges::min_element(times);
      ASSERT_EQ(soonest.time(), *least) << rows << " rows, change " << i;
      if (*least == Soonest::kNever) continue;
      const auto [first, after] = soonest.rows();
      ASSERT_EQ(first, least - times.begin()) << rows << " rows, change " << i;
      *least = Soonest::kNever;
      const double second = *std::ranges::min_element(times);
      if (second < Soonest::kNever) {
        ASSERT_NE(after, first) << rows << " rows, change " << i;
        ASSERT_EQ(times[after], second) << rows << " rows, change " << i;
      }
      times[first] = soonest.time();
    }
  }
}

}  // namespace
}  // namespace throng
