// SPDX-License-Identifier: MIT
#include "sim/contact/block_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace throng {
namespace {

constexpr std::size_t kWidth = BlockOrder::kWidth;

TEST(BlockOrder, FillsABlockWithContactsOfDifferentBodies) {
  BlockOrder order;
  order.start(20);
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(order.place(2 * i, true, 2 * i + 1, true), i);
  EXPECT_EQ(order.place(16, true, 17, true) / kWidth, 1u) << "the first block is full";
  EXPECT_EQ(order.blocks(), 2u);
  EXPECT_EQ(order.filled(0), 8u);
  EXPECT_EQ(order.filled(1), 1u);
}

TEST(BlockOrder, PutsWhoSharesABodyIntoALaterBlockAndOthersBesideTheFirst) {
  BlockOrder order;
  order.start(9);
  EXPECT_EQ(order.place(0, true, 1, true), 0u);
  EXPECT_GT(order.place(1, true, 2, true) / kWidth, 0u);
  EXPECT_EQ(order.place(3, true, 4, true), 1u);
}

TEST(BlockOrder, LetsWhoStandsStillStandInManyLanesOfABlock) {
  BlockOrder order;
  order.start(9);
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(order.place(i, true, 8, false), i);
}

TEST(BlockOrder, KeepsTheOrderOfContactsThatShareABodyAndFillsNearlyAllLanes) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  constexpr std::uint32_t kBodies = 500, kContacts = 2000;
  BlockOrder order;
  for (int run = 0; run < 2; ++run) {
    order.start(kBodies);
    std::vector<std::size_t> last(kBodies, 0);  // of each body: behind the block that it stood in last
    std::set<std::uint32_t> lanes;
    std::map<std::size_t, std::size_t> kinds;  // of blocks
    for (std::uint32_t i = 0; i < kContacts; ++i) {
      const std::uint32_t a = random() % kBodies, b = (a + 1 + random() % (kBodies - 1)) % kBodies;
      const bool a_moves = a % 10 != 0, b_moves = b % 10 != 0;
      const std::size_t kind = random() % 2;
      const std::uint32_t lane = order.place(a, a_moves, b, b_moves, kind);
      EXPECT_TRUE(lanes.insert(lane).second) << "a lane is taken once";
      const std::size_t block = lane / kWidth;
      EXPECT_EQ(kinds.try_emplace(block, kind).first->second, kind) << "of one kind";
      for (const auto& [body, moves] : {std::pair(a, a_moves), std::pair(b, b_moves)}) {
        if (!moves) continue;
        EXPECT_GE(block, last[body]);
        last[body] = block + 1;
      }
    }
    std::size_t filled = 0;
    for (std::size_t i = 0; i < order.blocks(); ++i) {
      for (std::size_t lane = 0; lane < order.filled(i); ++lane)
        EXPECT_TRUE(lanes.contains(static_cast<std::uint32_t>(i * kWidth + lane)));
      filled += order.filled(i);
    }
    EXPECT_EQ(filled, kContacts);
    EXPECT_LT(order.blocks(), kContacts / kWidth * 13 / 10);
  }
}

}  // namespace
}  // namespace throng
