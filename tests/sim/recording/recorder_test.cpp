// SPDX-License-Identifier: MIT
#include "sim/recording/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "sim/input_error.h"
#include "sim/recording/recording.h"
#include "tests/sim/recording/scenes.h"

namespace throng {
namespace {

using namespace testing_recordings;
using testing::HasSubstr;

TEST(Recorder, LeavesTheCompleteFileUnderItsFinalNameOnly) {
  const Folder folder;
  record_drift(folder / "a.h5", mixed_scene(50), 20);
  EXPECT_TRUE(std::filesystem::exists(folder / "a.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
}

TEST(Recorder, ShowsTheFinalNameOnlyOnceFinished) {
  const Folder folder;
  const Scene scene = mixed_scene(5);
  Recorder recorder(folder / "a.h5", scene, provenance());
  recorder.record(state_at(scene, 0));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
  EXPECT_EQ(recorder.frames(), 1u);
  recorder.finish({});
  EXPECT_TRUE(std::filesystem::exists(folder / "a.h5"));
}

TEST(Recorder, LeavesAReadablePartWhereTheRunDidNotFinish) {
  const Folder folder;
  const Scene scene = mixed_scene(5);
  {
    Recorder recorder(folder / "a.h5", scene, provenance());
    for (int i = 0; i < 7; ++i) recorder.record(state_at(scene, i));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
  const Recording recording(folder / "a.h5.part");
  EXPECT_FALSE(recording.complete());
  EXPECT_FALSE(recording.running());
  ASSERT_EQ(recording.frames(), 7u);
  EXPECT_EQ(recording.frame(6).position, state_at(scene, 6).position);
}

TEST(Recorder, StopsWithAReadablePart) {
  const Folder folder;
  const Scene scene = mixed_scene(5);
  Recorder recorder(folder / "a.h5", scene, provenance());
  for (int i = 0; i < 3; ++i) recorder.record(state_at(scene, i));
  recorder.stop();
  EXPECT_EQ(recorder.part(), folder / "a.h5.part");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
  EXPECT_EQ(Recording(recorder.part()).frames(), 3u);
}

/// A stopped run once said "closed and readable" of frames that were never written.
TEST(Recorder, StoppingTellsWhatWentWrong) {
  const Folder folder;
  const Scene scene = mixed_scene(5);
  Recorder recorder(folder / "a.h5", scene, provenance());
  recorder.record(state_at(scene, 0));
  State bad = state_at(scene, 1);
  bad.velocity[3].y() = std::numeric_limits<double>::quiet_NaN();
  recorder.record(bad);
  EXPECT_THROW(recorder.stop(), std::runtime_error);
  EXPECT_EQ(Recording(recorder.part()).frames(), 1u);
}

TEST(Recorder, LeavesNothingWhereNoFrameCame) {
  const Folder folder;
  { Recorder recorder(folder / "a.h5", mixed_scene(5), provenance()); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST(Recorder, RefusesARunThatTheDiskCannotHoldAndLeavesNothing) {
  const Folder folder;
  Scene scene = mixed_scene(1000);
  scene.time.until = 1e12;
  try {
    Recorder recorder(folder / "a.h5", scene, provenance());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("MB left"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

/// NaN never reaches the output: the frames before it are kept.
TEST(Recorder, RefusesAStateThatIsNotFiniteAndKeepsTheFramesBefore) {
  const Folder folder;
  const Scene scene = mixed_scene(5);
  Recorder recorder(folder / "a.h5", scene, provenance());
  recorder.record(state_at(scene, 0));
  recorder.record(state_at(scene, 1));
  State bad = state_at(scene, 2);
  bad.velocity[3].y() = std::numeric_limits<double>::quiet_NaN();
  recorder.record(bad);
  try {
    recorder.finish({});
    FAIL() << "finished";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("step 2"));
  }
  EXPECT_EQ(Recording(folder / "a.h5.part").frames(), 2u);
}

TEST(Recorder, StoresBodiesByIdWhateverTheirRows) {
  const Folder folder;
  const Scene scene = mixed_scene(4);
  const State straight = state_at(scene, 3);
  State mixed = straight;
  const std::size_t rows[] = {2, 0, 3, 1};
  for (std::size_t row = 0; row < 4; ++row) {
    mixed.id[row] = straight.id[rows[row]];
    mixed.position[row] = straight.position[rows[row]];
    mixed.angle[row] = straight.angle[rows[row]];
    mixed.velocity[row] = straight.velocity[rows[row]];
    mixed.spin[row] = straight.spin[rows[row]];
  }
  Recorder recorder(folder / "a.h5", scene, provenance());
  recorder.record(mixed);
  recorder.finish({});
  const Frame frame = Recording(folder / "a.h5").frame(0);
  EXPECT_EQ(frame.position, straight.position);
  EXPECT_EQ(frame.angle, straight.angle);
  EXPECT_EQ(frame.velocity, straight.velocity);
  EXPECT_EQ(frame.spin, straight.spin);
}

}  // namespace
}  // namespace throng
