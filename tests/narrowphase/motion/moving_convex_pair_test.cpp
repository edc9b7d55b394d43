// SPDX-License-Identifier: MIT
#include "narrowphase/motion/moving_convex_pair.h"

#include <gtest/gtest.h>

#include <limits>

namespace throng::narrowphase {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Two discs that pass each other through their middles from 0 to 4 s, in any unit of length.
TEST(Near, IsTheSameSpanInAnyUnit) {
  for (const double unit : {1.0, 0x1p-540, 0x1p-700, 0x1p480}) {
    const Convex a = disc(unit), b = disc(unit);
    const MovingConvexPair pair(a, {}, b, {{-2.5 * unit, 0}, 0, {unit, 0}, 0}, 9.0);
    const TimeSpan span = near(pair, 9.0);
    EXPECT_NEAR(span.from, 0.5, 1e-12) << unit;
    EXPECT_NEAR(span.until, 4.5, 1e-12) << unit;
  }
}

TEST(Near, IsAllOfItWhereSpeedsOverflow) {
  const Convex a = disc(1), b = disc(1);
  MovingConvexPair pair(a, {}, b, {{0.5, 0}, 0, {1, 0}, 0}, 1.0);
  pair.velocity = {1e200, 0};
  EXPECT_EQ(near(pair, 1.0).until, 1.0);
}

TEST(Near, IsAllOfItWhereNumbersAreNone) {
  const Convex a = disc(1), b = disc(1);
  for (const Vec& velocity : {Vec{1.0, 0.0}, Vec{0.0, 0.0}}) {
    MovingConvexPair pair(a, {}, b, {{1.5, 0}, 0, velocity, 0}, 1.0);
    EXPECT_EQ(near(pair, std::numeric_limits<double>::infinity()).until,
              std::numeric_limits<double>::infinity());
    pair.offset = {kNaN, 0.0};
    EXPECT_EQ(near(pair, 1.0).from, 0.0);
    EXPECT_EQ(near(pair, 1.0).until, 1.0);
  }
}

}  // namespace
}  // namespace throng::narrowphase
