// SPDX-License-Identifier: MIT
#include "sim/islands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

namespace throng {
namespace {

TEST(Islands, AreNamedAfterTheirSmallestRow) {
  Islands islands;
  islands.start(Rows::all(6), 6);
  islands.join(4, 2);
  islands.join(5, 4);
  islands.join(3, 3);
  const std::uint32_t expected[] = {0, 1, 2, 3, 2, 2};
  for (std::uint32_t row = 0; row < 6; ++row) EXPECT_EQ(islands.first(row), expected[row]) << row;
}

TEST(Islands, OfSomeRowsBeginAnewEachTime) {
  const std::array<std::uint32_t, 3> some{1, 4, 7};
  Islands islands;
  for (int i = 0; i < 2; ++i) {
    islands.start(Rows::of(some), 9);
    EXPECT_EQ(islands.first(7), 7u);
    islands.join(7, 1);
    EXPECT_EQ(islands.first(7), 1u);
    EXPECT_EQ(islands.first(4), 4u);
  }
}

/// Against the definition: everybody takes the smallest name about him until nobody's changes.
TEST(Islands, AreThoseOfTheDefinitionInWhateverOrderTheyAreJoined) {
  constexpr std::uint32_t kRows = 200;
  std::mt19937 random(5);
  std::uniform_int_distribution<std::uint32_t> row(0, kRows - 1);
  Islands islands;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::array<std::uint32_t, 2>> joins;
    for (int i = 0; i < 120; ++i) joins.push_back({row(random), row(random)});
    std::array<std::uint32_t, kRows> name;
    for (std::uint32_t i = 0; i < kRows; ++i) name[i] = i;
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [a, b] : joins) {
        const std::uint32_t least = std::min(name[a], name[b]);
        changed |= name[a] != least || name[b] != least;
        name[a] = name[b] = least;
      }
    }
    islands.start(Rows::all(kRows), kRows);
    for (const auto& [a, b] : joins) islands.join(a, b);
    for (std::uint32_t i = 0; i < kRows; ++i) ASSERT_EQ(islands.first(i), name[i]) << i;
    const std::size_t sets = std::set(name.begin(), name.end()).size();
    EXPECT_TRUE(sets > 60 && sets < 140) << sets << " islands test little";
  }
}

}  // namespace
}  // namespace throng
