// SPDX-License-Identifier: MIT
#include "sim/stage_clock.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

/// It happened: the second step, which was measured cold, stood for 31, also in runs of two.
TEST(StepSampling, NeverStandsForMoreStepsThanThereWere) {
  StepSampling sampling;
  int measured = 0;
  for (int steps = 1, sum = 0; steps <= 10000; ++steps) {
    const int stands_for = sampling.next();
    sampling.took(stands_for > 0 ? 1e-6 : 0.0);
    sum += stands_for;
    measured += stands_for > 0;
    EXPECT_LE(sum, steps);
    EXPECT_GE(sum, 0.75 * steps - 1) << steps;
  }
  EXPECT_LT(measured, 10000 / 32 + 20);
}

TEST(StepSampling, MeasuresAllStepsThatTakeLong) {
  StepSampling sampling;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(sampling.next(), 1);
    sampling.took(1e-4);
  }
}

}  // namespace
}  // namespace throng
