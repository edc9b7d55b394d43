// SPDX-License-Identifier: MIT
#include "sim/crowd/tally.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/random.h"

namespace throng {
namespace {

TEST(Tally, KnowsHowManyAreLessAsACountOfAllDoes) {
  Random random(1, 0, 1, Purpose::place);
  Tally tally;
  std::vector<double> all;
  const auto next = [&] { return std::round(random.uniform(0.0, 500.0)); };  // some are equal
  for (int i = 0; i < 1000; ++i) all.push_back(next()), tally.push(all.back());
  tally.settle();
  for (int i = 0; i < 3000; ++i) {
    const double x = next();
    ASSERT_EQ(tally.less_than(x),
              static_cast<std::size_t>(std::ranges::count_if(all, [&](double one) { return one < x; })));
    all.push_back(next()), tally.add(all.back());
  }
  tally.clear();
  EXPECT_EQ(tally.less_than(1e9), 0u);
}

}  // namespace
}  // namespace throng
