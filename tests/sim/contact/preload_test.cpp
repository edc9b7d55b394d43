// SPDX-License-Identifier: MIT
// What a contact has learnt to bear it bears without sinking.
#include <gtest/gtest.h>

#include "sim/contact/contact.h"
#include "sim/overlap.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

constexpr double kG = 9.81, kLoad = 1.0;

TEST(Preload, IsLearntFromBelowAndForgottenAtOnce) {
  const Learning learn{0.5, 0.01, 0.1};
  EXPECT_DOUBLE_EQ(learn(0.0, kLoad, 1.0, 0.0), 0.4);
  EXPECT_DOUBLE_EQ(learn(0.4, kLoad, 1.0, 0.0), 0.6);
  EXPECT_DOUBLE_EQ(learn(0.9, kLoad, 1.0, 0.0), 0.9);
  EXPECT_DOUBLE_EQ(learn(0.9, 0.5 * kLoad, 1.0, 0.0), 0.5 * kLoad);
  EXPECT_DOUBLE_EQ(learn(0.4, kLoad, 0.09, 0.0), 0.4);  // 1,100 times its own weight
  EXPECT_DOUBLE_EQ(learn(0.4, kLoad, 1.0, 0.099 * 0.099), 0.6);
  EXPECT_DOUBLE_EQ(learn(0.4, kLoad, 1.0, 0.101 * 0.101), 0.4);  // who passes by
}

/// A disc on the floor, from where it touches it. What it sinks there were no preload: the spring's gravity
/// over the square of its frequency.
TEST(Preload, LeavesAFifthOfTheSag) {
  constexpr double kDt = 0.01;
  constexpr int kSubsteps = 4;
  Trial trial("sleep = false\ngravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\n" +
              std::string(kDisc) +
              "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n[[bodies]]\nshape = \"ball\"\nat = [0, 0.5]\n");
  const double h = kDt / kSubsteps;
  const Softness soft = softness(0.18 / h, 20.0, h);
  const double sag = kG * h * soft.impulse_scale / (soft.mass_scale * soft.bias_rate);
  trial.steps(1000);
  EXPECT_NEAR(overlap(trial.scene, trial.state).max, 0.2 * sag, 0.002 * sag);
}

}  // namespace
}  // namespace throng
