// SPDX-License-Identifier: MIT
// Discs that give way and are so fast that they may pass others unseen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/simulation_error.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

const std::string kBouncySprings =
    spring(1e5) + "time = { dt = 0.01, until = 1, substeps = 10 }\n" + material(1.0, 0.0) + kDisc;

// In a trial discs of 1e6 m/s were behind walls and one another after a step, and the run said "done".
TEST(SoftSpeed, SaysWhoMayPassOthersUnseen) {
  const std::string wall = "[[walls]]\nsegment = [[2, -5], [2, 5]]\n";
  for (const std::string& met : {wall, ball(3, 0, 0, 0)}) {
    Trial trial(kBouncySprings + ball(0, 0, 0, 0) + met);
    trial.state.velocity[0] = Vec(1e6, 0.0);  // what the loader refuses
    try {
      trial.steps(1);
      ADD_FAILURE() << "went through";
    } catch (const SimulationError& error) {
      EXPECT_THAT(error.what(),
                  ::testing::HasSubstr("step 1: body 1 moves at 1e+06 m/s, so 1e+03 m in a substep"));
      EXPECT_THAT(error.what(), ::testing::HasSubstr("time.dt = 4.95e-06 s at most"));
    }
  }
}

TEST(SoftSpeed, SaysWhoBecomesSoFastAsHeFalls) {
  Trial trial("gravity = [0, -1e3]\n" + kBouncySprings + "[[walls]]\nsegment = [[-100, 0], [100, 0]]\n" +
              ball(0, 1e3, 0, 0));
  trial.steps(1);
  EXPECT_THROW(trial.steps(200), SimulationError);
  EXPECT_GT(trial.state.position[0].y(), 0.0) << "and not once he is through";
}

}  // namespace
}  // namespace throng
