// SPDX-License-Identifier: MIT
#include "sim/crowd/exponential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace throng {
namespace {

TEST(Exponential, IsExactWhereItIsAWholePowerOfE) {
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(-0.0), 1.0);
  EXPECT_DOUBLE_EQ(exponential(1.0), 2.718281828459045);
}

TEST(Exponential, IsWithinTwoUlpOfLibm) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-700.0, 700.0);
  double worst = 0.0;
  for (int i = 0; i < 200'000; ++i) {
    const double x = i % 2 ? uniform(random) : uniform(random) / 700.0, truth = std::exp(x);
    worst = std::max(worst, std::abs(exponential(x) - truth) / (std::nextafter(truth, INFINITY) - truth));
  }
  EXPECT_LE(worst, 2.0);
}

TEST(Exponential, StaysAtItsLeastBelowIt) {
  EXPECT_GT(exponential(-708.0), 0.0);
  EXPECT_EQ(exponential(-1e300), exponential(-708.0));
}

}  // namespace
}  // namespace throng
