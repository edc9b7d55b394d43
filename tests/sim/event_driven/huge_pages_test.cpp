// SPDX-License-Identifier: MIT
#include "sim/event_driven/huge_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace throng {
namespace {

struct alignas(64) CacheLine {
  std::uint64_t number;
};

TEST(HugePages, HoldWhatIsSmallAndWhatIsLargeInWholeLines) {
  constexpr std::size_t kLines = 100'000;  // 6.4 MB: pages from the 32,768th on
  std::vector<CacheLine, HugePages<CacheLine>> lines;
  for (std::size_t i = 0; i < kLines; ++i) {
    lines.push_back({i});
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(lines.data()) % alignof(CacheLine), 0u) << i;
  }
  for (std::size_t i = 0; i < kLines; ++i) ASSERT_EQ(lines[i].number, i);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(lines.data()) % (2 << 20), 0u);
  lines.resize(10), lines.shrink_to_fit();
  const std::vector<CacheLine, HugePages<CacheLine>> copy = lines;
  EXPECT_EQ(copy[9].number, 9u);
}

}  // namespace
}  // namespace throng
