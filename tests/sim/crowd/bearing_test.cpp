// SPDX-License-Identifier: MIT
#include "sim/crowd/bearing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace throng {
namespace {

TEST(Bearing, IsEachOnesOwnToEitherSide) {
  double least = 0.0, most = 0.0, sum = 0.0;
  for (std::uint32_t id = 1; id <= 1000; ++id) {
    const double its = bearing(7, id);
    EXPECT_EQ(its, bearing(7, id)) << "the same again";
    least = std::min(least, its), most = std::max(most, its), sum += its;
  }
  EXPECT_TRUE(least >= -kMostBearing && least < -0.9 * kMostBearing) << least;
  EXPECT_TRUE(most <= kMostBearing && most > 0.9 * kMostBearing) << most;
  EXPECT_LT(std::abs(sum / 1000), 0.1 * kMostBearing);
  EXPECT_NE(bearing(7, 1), bearing(8, 1)) << "by the seed";
}

}  // namespace
}  // namespace throng
