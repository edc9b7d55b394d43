// SPDX-License-Identifier: MIT
#include "sim/contact/buckets.h"

namespace throng {

namespace {
constexpr std::size_t kPart = 4096;  // numbers that one thread counts and puts down
}

void Buckets::sort(std::span<const std::uint8_t> of, std::size_t buckets, Workers& workers) {
  const std::size_t n = of.size(), parts = n / kPart + 1;
  numbers_.resize(n), begin_.resize(buckets + 1), next_.assign(parts * buckets, 0);
  const auto for_numbers = [&](auto f) {
    workers.for_each(parts, [&](std::size_t part) {
      std::uint32_t* next = next_.data() + part * buckets;
      for (std::size_t i = n * part / parts; i < n * (part + 1) / parts; ++i) f(next[of[i]], i);
    });
  };
  for_numbers([](std::uint32_t& count, std::size_t) { ++count; });
  std::uint32_t sum = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    begin_[bucket] = sum;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::uint32_t count = next_[part * buckets + bucket];
      next_[part * buckets + bucket] = sum;
      sum += count;
    }
  }
  begin_[buckets] = sum;
  for_numbers([&](std::uint32_t& next, std::size_t i) { numbers_[next++] = static_cast<std::uint32_t>(i); });
}

}  // namespace throng
