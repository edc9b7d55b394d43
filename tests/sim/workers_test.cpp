// SPDX-License-Identifier: MIT
#include "sim/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace throng {
namespace {

class SomeWorkers : public ::testing::TestWithParam<int> {};  // threads

TEST_P(SomeWorkers, DoEachRoundOnceLoopAfterLoop) {
  Workers workers(GetParam());
  std::vector<int> done(20000, 0);
  for (int shift = 0; shift < 50; ++shift) {
    const Workers::Shift stand_by(workers, done.size());
    for (int loop = 0; loop < 20; ++loop) {
      workers.for_ranges(done.size(), [&](std::size_t begin, std::size_t end) {
        for (; begin < end; ++begin) ++done[begin];
      });
      workers.for_each(7, [&](std::size_t i) { ++done[i]; });
      workers.for_each(0, [&](std::size_t) { FAIL(); });
    }
  }
  for (std::size_t i = 0; i < done.size(); ++i) ASSERT_EQ(done[i], i < 7 ? 2000 : 1000) << i;
}

TEST_P(SomeWorkers, DoThemWithoutAShiftToo) {
  Workers workers(GetParam());
  std::vector<int> done(20000, 0);
  workers.for_ranges(done.size(), [&](std::size_t begin, std::size_t end) {
    for (; begin < end; ++begin) ++done[begin];
  });
  EXPECT_EQ(done, std::vector<int>(20000, 1));
}

TEST_P(SomeWorkers, PassOnWhatTheLowestRangeThrew) {
  Workers workers(GetParam());
  for (int i = 0; i < 100; ++i) {
    const Workers::Shift stand_by(workers, 10000);
    auto fail = [&](std::size_t begin, std::size_t end) {
      if (begin <= 3000 && 3000 < end) throw std::runtime_error("first");
      if (begin <= 9000 && 9000 < end) throw std::runtime_error("second");
    };
    try {
      workers.for_ranges(10000, fail);
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "first");
    }
    std::atomic<std::size_t> after = 0;
    workers.for_ranges(10000, [&](std::size_t begin, std::size_t end) { after += end - begin; });
    EXPECT_EQ(after, 10000u) << "the next loop runs";
  }
}

INSTANTIATE_TEST_SUITE_P(, SomeWorkers, ::testing::Values(1, 2, 5));

}  // namespace
}  // namespace throng
