// SPDX-License-Identifier: MIT
#include "narrowphase/trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace throng::narrowphase {
namespace {

/// How many ulp of the exact value lie between it and `x`.
double ulps(double x, long double exact) {
  const double rounded = static_cast<double>(exact);
  const double ulp = std::nextafter(std::abs(rounded), INFINITY) - std::abs(rounded);
  return static_cast<double>(std::abs((static_cast<long double>(x) - exact) / ulp));
}

double worst_ulps(double range, int count) {
  std::mt19937_64 random(20240517);
  std::uniform_real_distribution<double> angle(-range, range);
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    const double x = angle(random);
    const SinCos u = sin_cos(x);
    worst = std::max({worst, ulps(u.sin, std::sin(static_cast<long double>(x))),
                      ulps(u.cos, std::cos(static_cast<long double>(x)))});
  }
  return worst;
}

TEST(SinCos, IsExactAtZeroAndKnowsTheSignOfZero) {
  EXPECT_EQ(sin_cos(0.0).sin, 0.0);
  EXPECT_EQ(sin_cos(0.0).cos, 1.0);
  EXPECT_TRUE(std::signbit(sin_cos(-0.0).sin));
}

TEST(SinCos, IsAHalfAtThirtyDegrees) {
  EXPECT_NEAR(sin_cos(std::numbers::pi / 6).sin, 0.5, 1e-16);
}

TEST(SinCos, IsWithinOneUlpOfLongDoubleForAnyUsualAngle) {
  EXPECT_LE(worst_ulps(0.8, 200000), 1.0) << "seed 20240517";
  EXPECT_LE(worst_ulps(7.0, 200000), 1.0) << "seed 20240517";
  EXPECT_LE(worst_ulps(1e4, 200000), 1.0) << "seed 20240517";
  EXPECT_LE(worst_ulps(1e9, 200000), 1.0) << "seed 20240517";
}

TEST(SinCos, IsWithinTwoUlpForHugeAngles) {
  EXPECT_LE(worst_ulps(1e17, 100000), 2.0) << "seed 20240517";
}

TEST(SinCos, KeepsItsDigitsNextToMultiplesOfAQuarterTurn) {
  for (int k = 1; k < 200000; k += 7) {
    const double x = k * (std::numbers::pi / 2);
    const SinCos u = sin_cos(x);
    const double small = k % 2 == 0 ? u.sin : u.cos;
    const long double exact =
        k % 2 == 0 ? std::sin(static_cast<long double>(x)) : std::cos(static_cast<long double>(x));
    ASSERT_NEAR(small, static_cast<double>(exact), 1e-19 * k) << k;
    ASSERT_NE(small, 0.0) << k;
  }
}

// mpmath at 400 digits; the first is the double closest to a multiple of pi/2, the nightmare of every
// reduction.
TEST(SinCos, MeetsTheHardestKnownAngles) {
  EXPECT_NEAR(sin_cos(6381956970095103.0 * std::ldexp(1.0, 797)).cos / -4.6871659242546277e-19, 1.0, 4e-16);
  EXPECT_NEAR(sin_cos(1e22).sin, -0.8522008497671888, 2e-16);
  EXPECT_NEAR(sin_cos(1e300).sin, -0.8178819121159085, 2e-16);
  EXPECT_NEAR(sin_cos(std::numeric_limits<double>::max()).cos, -0.9999876894265599, 2e-16);
}

TEST(SinCos, LiesOnTheUnitCircleWithinTwoUlpAndIsOddAndEvenToTheBit) {
  std::mt19937_64 random(20240517);
  std::uniform_real_distribution<double> angle(-100.0, 100.0);
  for (int i = 0; i < 100000; ++i) {
    const double x = angle(random);
    const SinCos u = sin_cos(x), mirrored = sin_cos(-x);
    ASSERT_NEAR(u.sin * u.sin + u.cos * u.cos, 1.0, 4.5e-16) << x;
    ASSERT_EQ(u.sin, -mirrored.sin) << x;
    ASSERT_EQ(u.cos, mirrored.cos) << x;
  }
}

TEST(SinCos, IsNotANumberWhereTheAngleIsNotFinite) {
  for (double x : {static_cast<double>(INFINITY), static_cast<double>(-INFINITY), std::nan("")}) {
    EXPECT_TRUE(std::isnan(sin_cos(x).sin));
    EXPECT_TRUE(std::isnan(sin_cos(x).cos));
  }
}

TEST(SinCos, TakesTheSmallestAnglesAsTheyAre) {
  for (double x : {1e-8, 1e-200, 5e-324})
    EXPECT_LE(ulps(sin_cos(x).sin, std::sin(static_cast<long double>(x))), 1.0) << x;
}

TEST(ArcTangent, KnowsTheAxesAndDiagonals) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(arc_tangent(0, 0), 0.0);
  EXPECT_EQ(arc_tangent(0, 3), 0.0);
  EXPECT_EQ(arc_tangent(3, 0), kPi / 2);
  EXPECT_EQ(arc_tangent(0, -3), kPi);
  EXPECT_EQ(arc_tangent(-3, 0), -kPi / 2);
  EXPECT_NEAR(arc_tangent(1e300, 1e300), kPi / 4, 2e-16);
  EXPECT_NEAR(arc_tangent(-1e-300, -1e-300), -3 * kPi / 4, 5e-16);
}

TEST(ArcTangent, IsWithinFourUlpOfLongDouble) {
  std::mt19937_64 random(20240517);
  std::normal_distribution<double> coordinate;
  std::uniform_real_distribution<double> exponent(-30, 30);
  for (int i = 0; i < 200000; ++i) {
    const double x = coordinate(random), y = coordinate(random) * std::exp2(exponent(random));
    ASSERT_LE(ulps(arc_tangent(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))),
              4.0)
        << y << " " << x << " seed 20240517";
  }
}

TEST(ArcCosine, IsWithinFourUlpOfLongDoubleUpToItsEnds) {
  EXPECT_EQ(arc_cosine(1.0), 0.0);
  EXPECT_EQ(arc_cosine(-1.0), std::numbers::pi);
  std::mt19937_64 random(20240517);
  std::uniform_real_distribution<double> exponent(-53, 0);
  for (int i = 0; i < 100000; ++i) {
    const double x = (i % 2 ? -1 : 1) * (1.0 - std::exp2(exponent(random)));
    ASSERT_LE(ulps(arc_cosine(x), std::acos(static_cast<long double>(x))), 4.0) << x << " seed 20240517";
  }
}

}  // namespace
}  // namespace throng::narrowphase
