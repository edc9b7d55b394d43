// SPDX-License-Identifier: MIT
#include "sim/recording/packed.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace throng::recording {
namespace {

using Numbers = std::vector<std::int32_t>;

TEST(Packed, RoundsToTheNearestMultiple) {
  EXPECT_EQ(quantized(1.2344, 0.001), 1234);
  EXPECT_EQ(quantized(1.2346, 0.001), 1235);
  EXPECT_EQ(quantized(-1.25, 0.5), -2) << "halves go up";
  EXPECT_EQ(quantized(1.25, 0.5), 3);
  EXPECT_EQ(quantized(-0.0, 1.0), 0);
}

TEST(Packed, KnowsTheLeastQuantumThatWillDo) {
  EXPECT_EQ(least_quantum(0.0), 0.0);
  EXPECT_EQ(least_quantum(60.0), 2.8e-8);
  EXPECT_EQ(least_quantum(1.0), 4.7e-10);
  for (double farthest = 1e-6; farthest < 1e12; farthest *= 1.37) {
    const double least = least_quantum(farthest);
    EXPECT_NO_THROW(quantized(farthest, least)) << farthest;
    EXPECT_NO_THROW(quantized(-farthest, least)) << farthest;
    EXPECT_THROW(quantized(farthest, 0.89 * least), std::range_error) << farthest;
  }
}

TEST(Packed, IsWrongByHalfAQuantumAtMost) {
  std::mt19937_64 random(7);
  for (double quantum : {1e-3, 0.37, 1e-9, 1000.0})
    for (int i = 0; i < 10'000; ++i) {
      const double x = (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5) * 2e9 * quantum;
      const std::int32_t n = quantized(x, quantum);
      EXPECT_LE(std::abs(n * quantum - x), 0.5 * quantum * (1 + 1e-6)) << x;
      EXPECT_EQ(quantized(n * quantum, quantum), n) << "what was read is stored as it was";
    }
}

TEST(Packed, RefusesWhatIsBeyond31Bits) {
  EXPECT_EQ(quantized(2147483647.0, 1.0), 2147483647);
  EXPECT_THROW(quantized(2147483648.0, 1.0), std::range_error);
  EXPECT_THROW(quantized(-2147483648.0, 1.0), std::range_error);
  EXPECT_THROW(quantized(1e300, 1e-9), std::range_error);
  EXPECT_THROW(quantized(std::numeric_limits<double>::quiet_NaN(), 1.0), std::range_error);
}

TEST(Packed, RoundsAllOrNone) {
  const double places[] = {1.2344, -1.25, 0.0, 7e5}, one_too_far[] = {1.2344, -1.25, 0.0, 7e7};
  Numbers numbers{1, 2, 3, 4, 5};
  EXPECT_THROW(quantize(one_too_far, 0.01, numbers), std::range_error);
  EXPECT_EQ(numbers, (Numbers{1, 2, 3, 4, 5}));
  quantize(places, 0.01, numbers);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(numbers[i], quantized(places[i], 0.01));
  EXPECT_EQ(numbers[4], 5);
  EXPECT_DEBUG_DEATH(quantize(places, 0.01, std::span(numbers).first(3)), "from.size");
}

/// A body that goes on as it went costs nothing: 100, 107, 114, 121, then 3 less, then a step back.
TEST(Packed, StoresHowMotionChanges) {
  const std::int32_t places[] = {100, 107, 114, 121, 125, 124};
  const std::uint32_t expected[] = {200, 14, 0, 0, 5, 9};
  Numbers before{0}, earlier{0};
  for (std::size_t k = 0; k < 6; ++k) {
    const Numbers now{places[k]};
    std::uint32_t stored = 0;
    predict(k, now, before, earlier, {&stored, 1});
    EXPECT_EQ(stored, expected[k]) << k;
    earlier = before, before = now;
  }
}

TEST(Packed, ComesBackFromAnyNumbersAtAll) {
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min(), kHigh = -(kLow + 1);
  std::mt19937 random(11);
  Numbers before{0, 0, 0}, earlier{0, 0, 0}, was{0, 0, 0}, was_earlier{0, 0, 0};
  for (std::size_t k = 0; k < 3 * kKeyEvery; ++k) {
    const Numbers now{static_cast<std::int32_t>(random()), k % 2 ? kLow : kHigh, k % 3 ? kHigh : kLow};
    std::vector<std::uint32_t> stored(3);
    predict(k, now, before, earlier, stored);
    Numbers back = was_earlier;
    restore(k, stored, was, was_earlier, back);
    EXPECT_EQ(back, now) << k;
    earlier = before, before = now, was_earlier = was, was = back;
  }
}

TEST(Packed, NeedsNothingOfTheFramesBeforeAKeyFrame) {
  const Numbers now{42, -7};
  std::vector<std::uint32_t> fresh(2), after(2);
  predict(kKeyEvery, now, Numbers{0, 0}, Numbers{0, 0}, fresh);
  predict(kKeyEvery, now, Numbers{9, 9}, Numbers{-3, 3}, after);
  EXPECT_EQ(fresh, after);
}

TEST(Packed, UnpacksWhatItPacked) {
  std::mt19937 random(3);
  for (std::size_t n : {0u, 1u, 2u, 7u, 1000u, 40'000u}) {
    std::vector<std::uint32_t> numbers(n), back(n, 5);
    for (std::uint32_t& x : numbers) x = random() >> random() % 32;
    std::vector<std::byte> bytes;
    pack(numbers, bytes);
    ASSERT_TRUE(unpack(bytes, back)) << n;
    EXPECT_EQ(back, numbers);
  }
}

TEST(Packed, RefusesBytesThatPackNeverMakes) {
  const std::vector<std::uint32_t> numbers(100, 1);
  std::vector<std::byte> bytes;
  pack(numbers, bytes);
  std::vector<std::uint32_t> more(101), fewer(99), same(100);
  EXPECT_FALSE(unpack(bytes, more));
  EXPECT_FALSE(unpack(bytes, fewer)) << "a bomb: more comes out than was asked for";
  EXPECT_FALSE(unpack(std::span(bytes).first(3), same));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::vector<std::byte> damaged = bytes;
    damaged[at] ^= std::byte{4};
    EXPECT_FALSE(unpack(damaged, same)) << at;
  }
}

}  // namespace
}  // namespace throng::recording
