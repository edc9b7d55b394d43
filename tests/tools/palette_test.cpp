// SPDX-License-Identifier: MIT
#include "tools/palette.h"

#include <gtest/gtest.h>

#include <vector>

namespace throng::tools {
namespace {

double luminance(const Colour& c) {
  return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
}

TEST(Palette, GrowsLighterAllTheWay) {
  for (int i = 0; i < 100; ++i) EXPECT_LT(luminance(palette(i / 100.0)), luminance(palette((i + 1) / 100.0)));
}

TEST(Palette, ClampsWhatLiesOutside) {
  EXPECT_EQ(palette(-1).green, palette(0).green);
  EXPECT_EQ(palette(7).green, palette(1).green);
}

TEST(Palette, GoesFromBlueToYellow) {
  const Colour slow = palette(0), fast = palette(1);
  EXPECT_GT(slow.blue, 2 * slow.green);
  EXPECT_DOUBLE_EQ(fast.red, 0.993);
  EXPECT_GT(fast.green, 5 * fast.blue);
}

TEST(Shade, IsTheSameColourDarker) {
  const Colour colour = palette(0.7), dark = shade(colour);
  EXPECT_LT(luminance(dark), 0.7 * luminance(colour));
  EXPECT_DOUBLE_EQ(dark.red * colour.blue, dark.blue * colour.red);
}

TEST(RoundBelow, GivesOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(round_below(7.3), 5);
  EXPECT_DOUBLE_EQ(round_below(4.9), 2);
  EXPECT_DOUBLE_EQ(round_below(1999), 1000);
  EXPECT_DOUBLE_EQ(round_below(5), 5);
  EXPECT_DOUBLE_EQ(round_below(0.0021), 0.002);
}

TEST(TopSpeed, CoversNearlyAllAndIsNotLedAstrayByOne) {
  std::vector<double> speeds(1000, 1.23);
  speeds[5] = 1e9;
  EXPECT_DOUBLE_EQ(top_speed(speeds.data(), 1000), 1.3);
}

TEST(TopSpeed, IsThe99thPercentileRoundedUp) {
  std::vector<double> speeds;
  for (int i = 0; i < 1000; ++i) speeds.push_back(1000 - i);  // 1 to 1000, the fastest first
  EXPECT_DOUBLE_EQ(top_speed(speeds.data(), 1000), 990);
  double one[] = {0.1234};
  EXPECT_DOUBLE_EQ(top_speed(one, 1), 0.13);
}

TEST(TopSpeed, IsZeroWhereNothingMoves) {
  std::vector<double> speeds(10, 0.0);
  EXPECT_EQ(top_speed(speeds.data(), 10), 0);
  EXPECT_EQ(top_speed(nullptr, 0), 0);
}

}  // namespace
}  // namespace throng::tools
