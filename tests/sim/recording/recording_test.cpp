// SPDX-License-Identifier: MIT
#include "sim/recording/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "sim/input_error.h"
#include "tests/sim/recording/scenes.h"

namespace throng {
namespace {

using namespace testing_recordings;
using testing::HasSubstr;

void expect_equal(const State& state, const Frame& frame, const Record& record) {
  EXPECT_EQ(frame.step, state.step);
  EXPECT_EQ(frame.state_hash, hash(state));
  EXPECT_EQ(frame.id, state.id);
  EXPECT_EQ(frame.position, record.position ? state.position : std::vector<Vec>{});
  EXPECT_EQ(frame.angle, record.angle ? state.angle : std::vector<double>{});
  EXPECT_EQ(frame.velocity, record.velocity ? state.velocity : std::vector<Vec>{});
  EXPECT_EQ(frame.spin, record.spin ? state.spin : std::vector<double>{});
}

std::string recording_refusal(const std::string& path) {
  try {
    Recording recording(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Recording, GivesBackEveryFrameBitForBit) {
  const Folder folder;
  Scene scene = mixed_scene(50);
  scene.record.every = 3;
  record_drift(folder / "a.h5", scene, 1100);  // more than two chunks of rows
  const Recording recording(folder / "a.h5");
  ASSERT_EQ(recording.frames(), 1100u);
  EXPECT_TRUE(recording.complete());
  EXPECT_FALSE(recording.running());
  for (int i = 0; i < 1100; ++i) expect_equal(state_at(scene, 3 * i), recording.frame(i), scene.record);
}

TEST(Recording, HoldsAnyChoiceOfFields) {
  const Folder folder;
  for (int choice = 0; choice < 16; ++choice) {
    Scene scene = mixed_scene(5);
    scene.record.position = choice & 1;
    scene.record.angle = choice & 2;
    scene.record.velocity = choice & 4;
    scene.record.spin = choice & 8;
    const std::string path = folder / std::to_string(choice).append(".h5");
    record_drift(path, scene, 3);
    const Recording recording(path);
    for (int i = 0; i < 3; ++i) expect_equal(state_at(scene, i), recording.frame(i), scene.record);
  }
}

TEST(Recording, HoldsSinglePrecisionRoundedOnce) {
  const Folder folder;
  Scene scene = mixed_scene(50);
  scene.record.single = true;
  record_drift(folder / "a.h5", scene, 3);
  const Recording recording(folder / "a.h5");
  EXPECT_TRUE(recording.geometry().record.single);
  const State state = state_at(scene, 2);
  const Frame frame = recording.frame(2);
  EXPECT_EQ(frame.state_hash, hash(state));
  for (std::size_t row = 0; row < 50; ++row) {
    EXPECT_EQ(frame.position[row], state.position[row].cast<float>().cast<double>());
    EXPECT_EQ(frame.angle[row], static_cast<float>(state.angle[row]));
  }
}

TEST(Recording, HoldsASceneOfNoBodies) {
  const Folder folder;
  record_drift(folder / "a.h5", mixed_scene(0), 4);
  const Recording recording(folder / "a.h5");
  EXPECT_EQ(recording.frames(), 4u);
  EXPECT_EQ(recording.frame(3).step, 3);
}

/// Frames larger than a chunk are split over bodies.
TEST(Recording, HoldsManyBodies) {
  const Folder folder;
  Scene scene = mixed_scene(150'000);
  record_drift(folder / "a.h5", scene, 2);
  expect_equal(state_at(scene, 1), Recording(folder / "a.h5").frame(1), scene.record);
}

TEST(Recording, TellsWhatDrawingNeeds) {
  const Folder folder;
  Scene scene = mixed_scene(7);
  scene.shapes[1].holes = {{{0, 0}, {0, 0.1}, {0.1, 0}},
                           {{-0.2, -0.2}, {-0.2, -0.1}, {-0.1, -0.1}, {0, -0.2}}};
  record_drift(folder / "a.h5", scene, 1);
  const Recording recording(folder / "a.h5");
  const Scene& read = recording.geometry();
  EXPECT_EQ(read.name, scene.name);
  EXPECT_EQ(read.seed, scene.seed);
  EXPECT_EQ(read.domain.kind, scene.domain.kind);
  EXPECT_EQ(read.domain.min, scene.domain.min);
  EXPECT_EQ(read.domain.max, scene.domain.max);
  ASSERT_EQ(read.shapes.size(), 3u);
  EXPECT_EQ(read.shapes[1].outline, scene.shapes[1].outline);
  for (std::size_t s = 0; s < 3; ++s) EXPECT_EQ(read.shapes[s].holes, scene.shapes[s].holes);
  EXPECT_EQ(read.shapes[1].parts[0].normals, scene.shapes[1].parts[0].normals);
  EXPECT_EQ(read.shapes[2].parts[1].vertices, scene.shapes[2].parts[1].vertices);
  EXPECT_EQ(read.shapes[2].parts[1].radius, 0.2);
  EXPECT_EQ(read.bodies.shape, scene.bodies.shape);
  EXPECT_EQ(read.bodies.kind, scene.bodies.kind);
  EXPECT_EQ(read.bodies.radius, scene.bodies.radius);
  ASSERT_EQ(read.walls.size(), 2u);
  EXPECT_EQ(read.walls[1].points, scene.walls[1].points);
  EXPECT_TRUE(read.walls[1].closed);
  EXPECT_FALSE(read.walls[0].closed);
  EXPECT_EQ(read.materials[1].name, "ice");
  EXPECT_EQ(recording.origin().provenance.scenario, provenance().scenario);
  EXPECT_EQ(recording.origin().provenance.resolved, provenance().resolved);
  EXPECT_EQ(recording.origin().provenance.command_line, provenance().command_line);
  EXPECT_EQ(recording.origin().provenance.threads, 2);
}

TEST(Recording, FindsTheFrameNearestInTime) {
  const Folder folder;
  Scene scene = mixed_scene(2);
  scene.time.dt = 0.25;
  record_drift(folder / "a.h5", scene, 5);
  const Recording recording(folder / "a.h5");
  EXPECT_EQ(recording.index_at(-3), 0u);
  EXPECT_EQ(recording.index_at(0.374), 1u);
  EXPECT_EQ(recording.index_at(0.375), 1u);
  EXPECT_EQ(recording.index_at(0.376), 2u);
  EXPECT_EQ(recording.index_at(99), 4u);
  EXPECT_EQ(recording.frame_at(0.6).step, 2);
}

TEST(Recording, RefusesWhatIsNoHdf5) {
  const Folder folder;
  std::ofstream(folder / "text.h5") << "throng = 1\n";
  std::ofstream(folder / "empty.h5");
  EXPECT_THAT(recording_refusal(folder / "text.h5"), HasSubstr("is no HDF5 file"));
  EXPECT_THAT(recording_refusal(folder / "empty.h5"), HasSubstr("is no HDF5 file"));
  EXPECT_THAT(recording_refusal(folder / "missing.h5"), HasSubstr("does not exist"));
  EXPECT_THAT(recording_refusal(folder.path), HasSubstr("is no regular file"));
  EXPECT_THAT(recording_refusal("/dev/zero"), HasSubstr("is no regular file"));
}

}  // namespace
}  // namespace throng
