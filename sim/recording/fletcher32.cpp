// SPDX-License-Identifier: MIT
#include "sim/recording/fletcher32.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace throng::recording {

namespace {

constexpr std::size_t kLanes = 16;
constexpr std::size_t kRows = 360;  // the most for which the second sum of a lane stays below 2^32

/// The sum of words, and the sum of its values after each of them.
struct Sums {
  std::uint64_t first = 0, second = 0;
};

/// Word 16 r + l goes to lane l. Expects 16 * `rows` words, at most kRows of them a lane.
Sums sums_of_rows(const std::byte* bytes, std::size_t rows) {
  std::array<std::uint32_t, kLanes> first{}, second{};
  for (std::size_t row = 0; row < rows; ++row) {
    std::array<std::uint16_t, kLanes> words;
    std::memcpy(words.data(), bytes + row * sizeof words, sizeof words);
    for (std::size_t l = 0; l < kLanes; ++l) first[l] += words[l];
    for (std::size_t l = 0; l < kLanes; ++l) second[l] += first[l];
  }
  Sums sums;
  for (std::size_t l = 0; l < kLanes; ++l) {
    sums.first += first[l];
    sums.second += kLanes * std::uint64_t{second[l]} - l * std::uint64_t{first[l]};
  }
  return sums;
}

/// `sum` modulo 65535, of which 0 is written as 65535 unless the sum is 0.
std::uint32_t folded(std::uint64_t sum) {
  return sum == 0 ? 0 : static_cast<std::uint32_t>((sum - 1) % 65535 + 1);
}

}  // namespace

/// Sums little-endian words: to swap the bytes of a word is to multiply it by 256, modulo 65535.
std::uint32_t fletcher32(std::span<const std::byte> bytes) {
  Sums sums;
  const auto add = [&](const Sums& next, std::size_t words) {
    sums.second = folded(sums.second + words * sums.first + next.second);
    sums.first = folded(sums.first + next.first);
  };
  std::size_t at = 0;
  while (bytes.size() - at >= 2 * kLanes) {
    const std::size_t rows = std::min(kRows, (bytes.size() - at) / (2 * kLanes));
    add(sums_of_rows(bytes.data() + at, rows), rows * kLanes);
    at += rows * 2 * kLanes;
  }
  for (; at < bytes.size(); at += 2) {
    std::uint16_t word = 0;  // a lone last byte is its low half
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(2, bytes.size() - at));
    add({word, word}, 1);
  }
  return folded(256 * sums.second) << 16 | folded(256 * sums.first);
}

}  // namespace throng::recording
