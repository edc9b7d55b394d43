// SPDX-License-Identifier: MIT
#include "sim/recording/frame_hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace throng::recording {
namespace {

std::vector<std::byte> pattern(std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(37 * i + 11);
  return bytes;
}

TEST(HashBytes, ChangesWithEveryBit) {
  std::set<std::uint64_t> seen{hash_bytes(pattern(101))};
  for (std::size_t bit = 0; bit < 8 * 101; ++bit) {
    auto bytes = pattern(101);
    bytes[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    seen.insert(hash_bytes(bytes));
  }
  EXPECT_EQ(seen.size(), 8u * 101 + 1);
}

TEST(HashBytes, ChangesWithTheLengthEvenOfZeros) {
  std::set<std::uint64_t> seen;
  for (std::size_t size = 0; size < 200; ++size) seen.insert(hash_bytes(std::vector<std::byte>(size)));
  EXPECT_EQ(seen.size(), 200u);
}

/// Files are read by later versions on other machines: these values must never change.
TEST(HashBytes, StaysWhatItWas) {
  EXPECT_EQ(hash_bytes({}), 0x37c50b2174dbff26ULL);
  EXPECT_EQ(hash_bytes(pattern(3)), 0xb4c1f89fbfb1c293ULL);
  EXPECT_EQ(hash_bytes(pattern(100)), 0xb1ff4f1dd861aacaULL);
}

/// Pieces of 32 bytes, of 64, 96 and so on, and what is left.
TEST(HashBytes, IsTheSameOfPieces) {
  for (std::size_t size = 0; size < 300; size += size < 70 ? 1 : 13)
    for (std::size_t piece = 32; piece <= 320; piece += 32) {
      const auto all = pattern(size);
      BytesHash hash;
      for (std::size_t at = 0; at < size; at += piece)
        hash.add(std::span(all).subspan(at, std::min(piece, size - at)));
      ASSERT_EQ(hash.value(), hash_bytes(all)) << size << " bytes in pieces of " << piece;
    }
}

TEST(FrameHash, DependsOnEveryNumberOfTheRowAndOnTheOrderOfFields) {
  const auto a = pattern(16), b = pattern(24);
  const auto of = [](std::int64_t step, double time, std::uint64_t state, const auto& first,
                     const auto& second) {
    FrameHash hash(step, time, state);
    hash.add(first);
    hash.add(second);
    return hash.value();
  };
  const std::set<std::uint64_t> seen{of(1, 0.1, 7, a, b), of(2, 0.1, 7, a, b), of(1, 0.2, 7, a, b),
                                     of(1, 0.1, 8, a, b), of(1, 0.1, 7, b, a)};
  EXPECT_EQ(seen.size(), 5u);
}

TEST(ChainHash, GoesOnWhereItStopped) {
  const std::vector<std::uint64_t> all{5, 6, 7};
  EXPECT_EQ(chain_hash(std::vector<std::uint64_t>{6, 7}, chain_hash(std::vector<std::uint64_t>{5})),
            chain_hash(all));
  EXPECT_NE(chain_hash(std::vector<std::uint64_t>{5, 6}), chain_hash(all));
}

}  // namespace
}  // namespace throng::recording
