// SPDX-License-Identifier: MIT
#include "sim/recording/fletcher32.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace throng::recording {
namespace {

/// Word by word, with the ones' complement sums that HDF5's file format has.
std::uint32_t by_definition(const std::vector<std::byte>& bytes) {
  std::uint32_t first = 0, second = 0;
  const auto fold = [](std::uint32_t x) { return (x & 0xffff) + (x >> 16); };
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    first = fold(first + (std::to_integer<std::uint32_t>(bytes[i]) << 8) +
                 std::to_integer<std::uint32_t>(bytes[i + 1]));
    second = fold(second + first);
  }
  return fold(second) << 16 | fold(first);
}

TEST(Fletcher32, IsTheSumsOfAFewWordsByHand) {
  const std::vector<std::byte> bytes{std::byte{1}, std::byte{2}, std::byte{0}, std::byte{3}};
  EXPECT_EQ(fletcher32(bytes), (0x0102u + 0x0105u) << 16 | 0x0105u);
  EXPECT_EQ(fletcher32({}), 0u);
}

/// All ones are where sums of this kind overflow first, and where 65535 stands for 0.
TEST(Fletcher32, IsWhatItsDefinitionSaysForAnySize) {
  std::mt19937 random(5);
  for (std::size_t size = 0; size < 60000; size = size < 200 ? size + 2 : size * 5 / 4 / 2 * 2)
    for (int kind = 0; kind < 4; ++kind) {
      std::vector<std::byte> bytes(size, kind == 0 ? std::byte{0xff} : std::byte{0});
      for (std::byte& b : bytes)
        if (kind >= 2 && (kind == 2 || random() % 50 == 0)) b = static_cast<std::byte>(random());
      ASSERT_EQ(fletcher32(bytes), by_definition(bytes)) << size << " bytes of kind " << kind;
    }
}

TEST(Fletcher32, IsTheSameOfPieces) {
  std::mt19937 random(6);
  std::vector<std::byte> bytes(40002);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random());
  for (const std::size_t piece : {2u, 30u, 32u, 8192u, 11520u, 20000u}) {
    Fletcher32 sum;
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      sum.add(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at)));
    EXPECT_EQ(sum.value(), by_definition(bytes)) << "in pieces of " << piece;
  }
}

}  // namespace
}  // namespace throng::recording
