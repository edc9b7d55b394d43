// SPDX-License-Identifier: MIT
#include "sim/recording/recording.h"

#include <gtest/gtest.h>

#include "tests/sim/recording/scenes.h"

namespace throng {
namespace {

using namespace testing_recordings;

void expect_equal(const State& state, const Frame& frame, const Record& record) {
  EXPECT_EQ(frame.step, state.step);
  EXPECT_EQ(frame.state_hash, hash(state));
  EXPECT_EQ(frame.id, state.id);
  EXPECT_EQ(frame.position, record.position ? state.position : std::vector<Vec>{});
  EXPECT_EQ(frame.angle, record.angle ? state.angle : std::vector<double>{});
  EXPECT_EQ(frame.velocity, record.velocity ? state.velocity : std::vector<Vec>{});
  EXPECT_EQ(frame.spin, record.spin ? state.spin : std::vector<double>{});
}

TEST(Recording, GivesBackEveryFrameBitForBit) {
  const Folder folder;
  Scene scene = mixed_scene(50);
  scene.record.every = 3;
  record_drift(folder / "a.h5", scene, 20);
  const Recording recording(folder / "a.h5");
  ASSERT_EQ(recording.frames(), 20u);
  EXPECT_TRUE(recording.complete());
  EXPECT_FALSE(recording.running());
  for (int i = 0; i < 20; ++i) expect_equal(state_at(scene, 3 * i), recording.frame(i), scene.record);
}

}  // namespace
}  // namespace throng
