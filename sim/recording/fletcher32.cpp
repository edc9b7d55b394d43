// SPDX-License-Identifier: MIT
#include "sim/recording/fletcher32.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace throng::recording {

namespace {

/// Pairs of words, the first of them in the lower half: what any x86-64 holds in a register.
using Pairs [[gnu::vector_size(16)]] = std::uint32_t;

constexpr std::size_t kLanes = 8;  // pairs in two of them
constexpr std::size_t kRowBytes = kLanes * sizeof(std::uint32_t);
constexpr std::size_t kMostRows = 360;  // the most for which the second sum of a lane stays below 2^32

/// The sum of words, and the sum of its values after each of them.
struct Sums {
  std::uint64_t first = 0, second = 0;
};

/// The same of every 16th word, in four lanes at once.
struct LaneSums {
  Pairs first{}, second{};

  void add(Pairs words) {
    first += words;
    second += first;
  }

  /// Adds to the sums of all words, of which lane l has word `from` + 2 l first.
  void add_to(Sums& sums, std::size_t from) const {
    for (std::size_t l = 0; l < 4; ++l) {
      sums.first += first[l];
      sums.second += 2 * kLanes * std::uint64_t{second[l]} - (from + 2 * l) * std::uint64_t{first[l]};
    }
  }
};

/// Of `rows` rows, at most kMostRows. In registers: compilers left sums in arrays in memory, at a third of
/// the speed.
Sums sums_of_rows(const std::byte* bytes, std::size_t rows) {
  LaneSums low_even, low_odd, high_even, high_odd;
  for (std::size_t row = 0; row < rows; ++row) {
    Pairs low, high;
    std::memcpy(&low, bytes + row * kRowBytes, sizeof low);
    std::memcpy(&high, bytes + row * kRowBytes + sizeof low, sizeof high);
    low_even.add(low & 0xffff), low_odd.add(low >> 16);
    high_even.add(high & 0xffff), high_odd.add(high >> 16);
  }
  Sums sums;
  low_even.add_to(sums, 0), low_odd.add_to(sums, 1);
  high_even.add_to(sums, 8), high_odd.add_to(sums, 9);
  return sums;
}

/// `sum` modulo 65535, of which 0 is written as 65535 unless the sum is 0.
std::uint32_t folded(std::uint64_t sum) {
  return sum == 0 ? 0 : static_cast<std::uint32_t>((sum - 1) % 65535 + 1);
}

}  // namespace

void Fletcher32::add(std::span<const std::byte> bytes) {
  const auto add = [&](const Sums& next, std::size_t words) {
    second_ = folded(second_ + words * first_ + next.second);
    first_ = folded(first_ + next.first);
  };
  std::size_t at = 0;
  while (bytes.size() - at >= kRowBytes) {
    const std::size_t rows = std::min(kMostRows, (bytes.size() - at) / kRowBytes);
    add(sums_of_rows(bytes.data() + at, rows), rows * 2 * kLanes);
    at += rows * kRowBytes;
  }
  for (; at < bytes.size(); at += 2) {
    std::uint16_t word = 0;  // a lone last byte is its low half
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(2, bytes.size() - at));
    add({word, word}, 1);
  }
}

/// To swap the bytes of a word is to multiply it by 256, modulo 65535.
std::uint32_t Fletcher32::value() const {
  return folded(256 * second_) << 16 | folded(256 * first_);
}

std::uint32_t fletcher32(std::span<const std::byte> bytes) {
  Fletcher32 sum;
  sum.add(bytes);
  return sum.value();
}

}  // namespace throng::recording
