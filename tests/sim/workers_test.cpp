// SPDX-License-Identifier: MIT
#include "sim/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <vector>

namespace throng {
namespace {

const std::vector<std::size_t> kSizes{0, 1, 511, 512, 513, 1024, 5000};

TEST(Workers, GoThroughAllOnce) {
  for (const int threads : {1, 2, 5})
    for (const std::size_t n : kSizes) {
      Workers workers(threads);
      std::vector<std::atomic<int>> ranged(n), each(n);
      workers.for_ranges(n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++ranged[i];
      });
      workers.for_few(n, [&](std::size_t i) { ++each[i]; });
      for (std::size_t i = 0; i < n; ++i) EXPECT_TRUE(ranged[i] == 1 && each[i] == 1) << i << " of " << n;
    }
}

bool chosen(std::size_t i) {
  return i % 3 == 0 || i % 7 == 2;
}

/// Of each that is chosen so many numbers: none, one or two.
std::vector<std::size_t> gathered(std::size_t n) {
  std::vector<std::size_t> all{99};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < i % 3; ++k) all.push_back(2 * i + k);
  return all;
}

TEST(Workers, GatherInOrder) {
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    std::vector<std::vector<std::size_t>> lists;
    for (const std::size_t n : {std::size_t{6000}, std::size_t{900}, std::size_t{7}, std::size_t{0}}) {
      std::vector<std::size_t> all{99};
      workers.gather(n, lists, all, [](std::size_t begin, std::size_t end, auto& list) {
        for (std::size_t i = begin; i < end; ++i)
          for (std::size_t k = 0; k < i % 3; ++k) list.push_back(2 * i + k);
      });
      EXPECT_EQ(all, gathered(n)) << n;
    }
  }
}

TEST(Workers, SelectInOrder) {
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    std::vector<std::size_t> counts, all{1, 2, 3};
    for (const std::size_t n : kSizes) {
      const auto count = [](std::size_t begin, std::size_t end) {
        std::size_t some = 0;
        for (std::size_t i = begin; i < end; ++i) some += chosen(i);
        return some;
      };
      workers.select(n, counts, all, count, [](std::size_t begin, std::size_t end, auto out) {
        for (std::size_t i = begin; i < end; ++i)
          if (chosen(i)) *out++ = i;
      });
      std::vector<std::size_t> expected;
      for (std::size_t i = 0; i < n; ++i)
        if (chosen(i)) expected.push_back(i);
      EXPECT_EQ(all, expected) << n;
    }
  }
}

}  // namespace
}  // namespace throng
