// SPDX-License-Identifier: MIT
#include "sim/recording/recorder.h"

#include <gtest/gtest.h>

#include "tests/sim/recording/scenes.h"

namespace throng {
namespace {

using namespace testing_recordings;

TEST(Recorder, LeavesTheCompleteFileUnderItsFinalNameOnly) {
  const Folder folder;
  record_drift(folder / "a.h5", mixed_scene(50), 20);
  EXPECT_TRUE(std::filesystem::exists(folder / "a.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
}

}  // namespace
}  // namespace throng
