// SPDX-License-Identifier: MIT
#include "sim/recording/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <random>

#include "sim/input_error.h"
#include "tests/sim/recording/scenes.h"

namespace throng::recording {
namespace {

using namespace testing_recordings;
using testing::HasSubstr;

State touching_state(std::int64_t step) {
  State state = state_at(mixed_scene(7), step);
  state.disc_contacts = {{1, 0, 0.5, -0.25, 0.125}, {1u << 30, 0, 1.5, 0.0}};
  state.point_contacts = {{3, 9, 0.1, 0.2}, {3, 10, 0.3, -0.4}, {std::uint64_t{1} << 63, 0, 7.0, -0.0}};
  return state;
}

CheckpointOrigin origin(std::uint64_t frames = 3) {
  return {"0.1.0", "throng = 1\n[time]\nuntil = 2.0\n", frames, 0x1234567890abcdef};
}

std::string checkpoint_refusal(const std::string& path) {
  try {
    read_checkpoint(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_equal(const std::vector<ContactImpulse>& a, const std::vector<ContactImpulse>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].key, b[i].key);
    EXPECT_EQ(a[i].feature, b[i].feature);
    EXPECT_EQ(a[i].normal, b[i].normal);
    EXPECT_EQ(a[i].tangent, b[i].tangent);
    EXPECT_EQ(a[i].rolling, b[i].rolling);
    EXPECT_EQ(a[i].preload, b[i].preload);
  }
}

TEST(Checkpoint, GivesBackAllThatWasWritten) {
  const Folder folder;
  State state = touching_state(41);
  std::swap(state.id[2], state.id[5]);  // rows may move
  state.collisions = {1, 2, 3, 0.25, 0.125};
  write_checkpoint(folder / "a.ckpt", origin(), state);
  const Checkpoint read = read_checkpoint(folder / "a.ckpt");
  EXPECT_EQ(read.origin.version, "0.1.0");
  EXPECT_EQ(read.origin.scenario, origin().scenario);
  EXPECT_EQ(read.origin.frames, 3u);
  EXPECT_EQ(read.origin.frames_hash, 0x1234567890abcdefu);
  EXPECT_EQ(read.state.step, 41);
  EXPECT_EQ(read.state.id, state.id);
  EXPECT_EQ(read.state.position, state.position);
  EXPECT_EQ(read.state.angle, state.angle);
  EXPECT_EQ(read.state.velocity, state.velocity);
  EXPECT_EQ(read.state.spin, state.spin);
  EXPECT_EQ(read.state.collisions, state.collisions);
  expect_equal(read.state.disc_contacts, state.disc_contacts);
  expect_equal(read.state.point_contacts, state.point_contacts);
}

TEST(Checkpoint, HoldsASceneWithoutBodies) {
  const Folder folder;
  write_checkpoint(folder / "a.ckpt", {"0.1.0", "", 1, 2}, State());
  EXPECT_EQ(read_checkpoint(folder / "a.ckpt").state.id.size(), 0u);
}

TEST(Checkpoint, KeepsTheOneBeforeAndNoMore) {
  const Folder folder;
  for (int step : {1, 2, 3}) write_checkpoint(folder / "a.ckpt", origin(), touching_state(step));
  EXPECT_EQ(read_checkpoint(folder / "a.ckpt").state.step, 3);
  EXPECT_EQ(read_checkpoint(folder / "a.ckpt.prev").state.step, 2);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 2);
}

TEST(Checkpoint, LeavesTheOneBeforeWhereItCannotBeWritten) {
  const Folder folder;
  write_checkpoint(folder / "a.ckpt", origin(), touching_state(1));
  std::filesystem::create_directory(folder / "a.ckpt.tmp");
  try {
    write_checkpoint(folder / "a.ckpt", origin(), touching_state(2));
    FAIL() << "written";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot write " + (folder / "a.ckpt.tmp: Is a directory")));
  }
  EXPECT_EQ(read_checkpoint(folder / "a.ckpt").state.step, 1);
}

TEST(Checkpoint, IsRemovedWithAllOfItsNames) {
  const Folder folder;
  for (const char* name : {"a.h5.ckpt", "a.h5.ckpt.prev", "a.h5.ckpt.tmp"})
    std::ofstream(folder / name) << "x";
  std::ofstream(folder / "a.h5") << "x";
  remove_checkpoints(folder / "a.h5");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1);
}

TEST(Checkpoint, EveryFlippedByteIsSeen) {
  const Folder folder;
  write_checkpoint(folder / "a.ckpt", origin(), touching_state(5));
  const std::string good = content(folder / "a.ckpt");
  ASSERT_GT(good.size(), 500u);
  for (std::size_t at = 0; at < good.size(); ++at)
    for (char flip : {1, -128}) {
      std::string bytes = good;
      bytes[at] ^= flip;
      std::ofstream(folder / "bad.ckpt", std::ios::binary) << bytes;
      ASSERT_THAT(checkpoint_refusal(folder / "bad.ckpt"),
                  testing::AnyOf(HasSubstr("is damaged"), HasSubstr("no checkpoint")))
          << "byte " << at;
    }
}

TEST(Checkpoint, EveryTruncationAndEveryAdditionIsSeen) {
  const Folder folder;
  write_checkpoint(folder / "a.ckpt", origin(), touching_state(5));
  const std::string good = content(folder / "a.ckpt");
  for (std::size_t size = 0; size < good.size(); ++size) {
    std::ofstream(folder / "bad.ckpt", std::ios::binary) << good.substr(0, size);
    ASSERT_NE(checkpoint_refusal(folder / "bad.ckpt"), "accepted") << size << " bytes";
  }
  std::ofstream(folder / "bad.ckpt", std::ios::binary) << good << '\0';
  EXPECT_THAT(checkpoint_refusal(folder / "bad.ckpt"), HasSubstr("its size is not what its header says"));
}

TEST(Checkpoint, SaysWhatIsWrongWithAFileThatIsNone) {
  const Folder folder;
  EXPECT_THAT(checkpoint_refusal(folder / "none"), HasSubstr("does not exist"));
  std::filesystem::create_directory(folder / "folder");
  EXPECT_THAT(checkpoint_refusal(folder / "folder"), HasSubstr("is no regular file"));
  std::ofstream(folder / "text") << std::string(1000, 'x');
  EXPECT_THAT(checkpoint_refusal(folder / "text"), HasSubstr("is no checkpoint"));
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether `state`, under sound checksums, is refused for what it is.
bool is_refused(const State& state) {
  const Folder folder;
  write_checkpoint(folder / "a.ckpt", origin(), state);
  return checkpoint_refusal(folder / "a.ckpt").find("its state cannot be that of a run") != std::string::npos;
}

bool is_refused(void change(State&)) {
  State state = touching_state(5);
  change(state);
  return is_refused(state);
}

/// Numbers that are not finite, ids twice, contacts out of order.
TEST(Checkpoint, RefusesStatesThatNoRunHas) {
  const auto refused = [](void change(State&)) { return is_refused(change); };
  EXPECT_FALSE(refused([](State&) {}));
  EXPECT_TRUE(refused([](State& s) { s.position[1].y() = nan; }));
  EXPECT_TRUE(refused([](State& s) { s.velocity[1].x() = nan; }));
  EXPECT_TRUE(refused([](State& s) { s.angle[1] = nan; }));
  EXPECT_TRUE(refused([](State& s) { s.spin[6] = nan; }));
  EXPECT_TRUE(refused([](State& s) { s.disc_contacts[1].normal = nan; }));
  EXPECT_TRUE(refused([](State& s) { s.point_contacts[2].tangent = nan; }));
  EXPECT_TRUE(refused([](State& s) { s.disc_contacts[0].rolling = nan; }));
  EXPECT_TRUE(refused([](State& s) { s.point_contacts[1].preload = nan; }));
  EXPECT_TRUE(refused([](State& s) { std::swap(s.disc_contacts[0], s.disc_contacts[1]); }));
  EXPECT_TRUE(refused([](State& s) { std::swap(s.point_contacts[0], s.point_contacts[2]); }));
  EXPECT_TRUE(refused([](State& s) { s.id[3] = s.id[2]; }));
  EXPECT_TRUE(refused([](State& s) { s.id[3] = 0; }));
  EXPECT_TRUE(refused([](State& s) { s.id[3] = 8; }));
  EXPECT_TRUE(refused([](State& s) { s.step = -1; }));
  EXPECT_TRUE(refused([](State& s) { s.collisions.walls = -1; }));
  EXPECT_TRUE(refused([](State& s) { s.collisions.virial = nan; }));
  EXPECT_TRUE(refused([](State& s) { s.collisions.equilibrium = infinity; }));
}

/// It happened: a finite velocity of 1e200 m/s passed, its square did not, and the broadphase was asked for
/// infinite discs.
TEST(Checkpoint, RefusesPlacesAndSpeedsThatEveryStepWouldHaveRefused) {
  const auto refused = [](void change(State&)) { return is_refused(change); };
  EXPECT_FALSE(refused([](State& s) { s.position[1] = {9.9e11, -9.9e11}; }));
  EXPECT_TRUE(refused([](State& s) { s.position[1].x() = 1e12; }));
  EXPECT_TRUE(refused([](State& s) { s.position[1].y() = -1e300; }));
  EXPECT_FALSE(refused([](State& s) { s.velocity[1] = {9e153, -9e153}; }));
  EXPECT_TRUE(refused([](State& s) { s.velocity[1].x() = 1e200; }));
  EXPECT_TRUE(refused([](State& s) { s.velocity[1] = {-1e154, 1e154}; }));
  EXPECT_TRUE(refused([](State& s) { s.velocity[1].y() = infinity; }));
  EXPECT_TRUE(refused([](State& s) { s.spin[1] = -1e200; }));
  EXPECT_TRUE(refused([](State& s) { s.angle[1] = infinity; }));
  EXPECT_TRUE(refused([](State& s) { s.disc_contacts[1].tangent = infinity; }));
  EXPECT_TRUE(refused([](State& s) { s.point_contacts[1].normal = infinity; }));
}

TEST(Checkpoint, RefusesCrowdsThatNoRunHas) {
  const auto refused = [](auto change) {
    State state = state_at(mixed_scene(7), 5);
    state.crowd.stand = state.position;
    state.crowd.spot = state.crowd.halt = state.position;
    state.crowd.halt_step.assign(7, 5);
    state.crowd.stand_step.assign(7, 5), state.crowd.stage.assign(7, 0), state.crowd.since.assign(7, 0);
    state.crowd.option.assign(7, 0), state.crowd.place.assign(7, 0);
    state.crowd.waiting = {2, 0};
    change(state.crowd);
    return is_refused(state);
  };
  EXPECT_FALSE(refused([](CrowdState&) {}));
  const auto arrived = [&](std::vector<std::int64_t> steps, std::vector<std::uint32_t> ids) {
    return refused([&](CrowdState& c) { c.arrivals = steps, c.arrived_id = ids, c.wall_corrections = 9; });
  };
  EXPECT_FALSE(arrived({1, 5, 5}, {8, 9, 10}));
  EXPECT_FALSE(arrived({1, 5, 5}, {10, 8, 9}));
  EXPECT_FALSE(arrived({1, 5, 5}, {8, 9, 12})) << "fits() knows who waits";
  EXPECT_TRUE(arrived({1, 5, 5}, {8, 10, 9}));
  EXPECT_TRUE(arrived({1, 5, 5}, {8, 9, 13}));
  EXPECT_TRUE(arrived({1, 5, 5}, {8, 9, 9}));
  EXPECT_TRUE(arrived({1, 5, 5}, {8, 9, 7})) << "is there";
  EXPECT_TRUE(arrived({1, 5, 5}, {8, 9, 0}));
  EXPECT_TRUE(arrived({6}, {8}));
  EXPECT_TRUE(arrived({0}, {8}));
  EXPECT_TRUE(arrived({5, 4}, {8, 9}));
  EXPECT_TRUE(refused([](CrowdState& c) { c.stand[6].x() = nan; }));
  EXPECT_TRUE(refused([](CrowdState& c) { c.stand[6].y() = -1e12; }));
  EXPECT_TRUE(refused([](CrowdState& c) { c.stand_step[6] = 6; }));
  EXPECT_TRUE(refused([](CrowdState& c) { c.stand_step[0] = -1; }));
  EXPECT_TRUE(refused([](CrowdState& c) { c.halt[6].x() = nan; }));
  EXPECT_TRUE(refused([](CrowdState& c) { c.halt_step[6] = 6; }));
  EXPECT_TRUE(refused([](CrowdState& c) { c.since[1] = 6; }));
  EXPECT_TRUE(refused([](CrowdState& c) { c.spot[6].y() = infinity; }));
  EXPECT_TRUE(refused([](CrowdState& c) { c.wall_corrections = -1; }));
  EXPECT_TRUE(refused([](CrowdState& c) { c.wall_corrections = std::numeric_limits<std::int64_t>::max(); }));
  const auto measured = [&](Measured m) { return refused([=](CrowdState& c) { c.measured = {m}; }); };
  EXPECT_FALSE(measured({3, 1, 2, 5, 5, 4, 6.5}));
  EXPECT_TRUE(measured({-3, 1, 2, 5, 5, 4, 6.5}));
  EXPECT_TRUE(measured({3, -1, 2, 5, 5, 4, 6.5}));
  EXPECT_TRUE(measured({3, 1, 4, 3, 5, 4, 6.5}));
  EXPECT_TRUE(measured({3, 1, 2, 6, 5, 4, 6.5}));
  EXPECT_TRUE(measured({3, 1, 2, 5, 6, 4, 6.5}));
  EXPECT_TRUE(measured({3, 1, 2, 5, 5, -4, 6.5}));
  EXPECT_TRUE(measured({3, 1, 2, 5, 5, 4, nan}));
  EXPECT_TRUE(measured({3, 1, 2, 5, 5, 4, -1}));
  EXPECT_TRUE(measured({3, 1, 2, 5, 5, 4, 6.5, infinity}));
  EXPECT_TRUE(measured({std::numeric_limits<std::int64_t>::max(), 1, 2, 5, 5, 4, 6.5}));
  const auto on_line = [&](std::vector<OnLine> all) {
    return refused([&](CrowdState& c) { c.measured.resize(2), c.on_line = all; });
  };
  EXPECT_FALSE(on_line({{0, 3, 0}, {1, 2, -1}, {1, 3, 2}}));
  EXPECT_TRUE(on_line({{1, 2, 0}, {0, 3, 0}}));
  EXPECT_TRUE(on_line({{1, 3, 0}, {1, 2, 0}}));
  EXPECT_TRUE(on_line({{1, 3, 0}, {1, 3, 0}}));
  EXPECT_TRUE(on_line({{1, 3, std::numeric_limits<std::int32_t>::max()}}));
  EXPECT_TRUE(on_line({{1, 3, std::numeric_limits<std::int32_t>::min()}}));
}

}  // namespace
}  // namespace throng::recording
