// SPDX-License-Identifier: MIT
// H4 and H8: what is left when a recorder is killed, or the disk is full. Each victim is a process of its
// own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "sim/recording/recording.h"
#include "tests/durability/durable_run.h"
#include "tests/sim/recording/scenes.h"

namespace throng {
namespace {

using namespace testing_recordings;
using testing::HasSubstr;

constexpr std::size_t kManyBodies = 2000;

/// A child process that does `work` and exits the ordinary way with what it returns.
pid_t start(const std::function<int()>& work) {
  const pid_t child = fork();
  if (child == 0) std::exit(work());
  return child;
}

int status_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

/// Records until it is stopped from outside.
int record_for_ever(const std::string& path) {
  const Scene scene = mixed_scene(kManyBodies);
  Recorder recorder(path, scene, provenance());
  for (std::int64_t step = 0;; ++step) recorder.record(state_at(scene, step));
}

/// Opens the part once the run has committed something.
Recording wait_for_frames(const std::string& part) {
  for (;;) {
    try {
      Recording recording(part);
      if (recording.frames() > 0) return recording;
    } catch (const std::exception&) {  // not there yet, or being made
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void expect_all_frames_right(const Recording& recording) {
  const Scene scene = mixed_scene(kManyBodies);
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    const State state = state_at(scene, static_cast<std::int64_t>(i));
    const Frame frame = recording.frame(i);
    ASSERT_EQ(frame.state_hash, hash(state)) << "frame " << i;
    ASSERT_EQ(frame.position, state.position) << "frame " << i;
  }
}

TEST(Durability, ARunCanBeFollowedAndItsFramesSurviveAKill) {
  const Folder folder;
  const std::string part = folder / "a.h5.part";
  const pid_t child = start([&] { return record_for_ever(folder / "a.h5"); });
  std::size_t seen = 0;
  {
    const Recording live = wait_for_frames(part);
    EXPECT_TRUE(live.running());
    EXPECT_FALSE(live.complete());
    expect_all_frames_right(live);
    seen = live.frames();
  }
  kill(child, SIGKILL);
  EXPECT_TRUE(WIFSIGNALED(status_of(child)));
  const Recording left(part);
  EXPECT_FALSE(left.running());
  EXPECT_FALSE(left.complete());
  EXPECT_GE(left.frames(), seen);
  expect_all_frames_right(left);
}

/// Records a hundred frames where files may not grow beyond `limit` bytes. Returns 3 where that ended with
/// the right sentence.
int record_within(const std::string& path, rlim_t limit) {
  const rlimit bytes{limit, limit};
  setrlimit(RLIMIT_FSIZE, &bytes);
  try {
    record_drift(path, mixed_scene(20), 100);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    if (text.find(path + ".part") != std::string::npos && text.find("File too large") != std::string::npos)
      return 3;
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 4;
}

/// The errors of a full disk, by a limit on the file's size: at many sizes, so that every kind of write fails
/// once, from the first header to the closing of the complete file.
TEST(Durability, AFullDiskEndsWithASentenceAndNeverWithASignal) {
  const Folder whole;
  record_drift(whole / "a.h5", mixed_scene(20), 100);
  const rlim_t size = std::filesystem::file_size(whole / "a.h5");
  for (rlim_t limit = 500; limit < size; limit += size / static_cast<rlim_t>(cases(60, 60))) {
    const Folder folder;
    const int status = status_of(start([&] { return record_within(folder / "a.h5", limit); }));
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status) << " at " << limit << " bytes of "
                                   << size;
    EXPECT_EQ(WEXITSTATUS(status), 3) << "at " << limit << " bytes";
    EXPECT_TRUE(std::filesystem::is_empty(folder.path)) << "no frame was committed at " << limit << " bytes";
  }
}

TEST(Durability, FramesCommittedBeforeTheDiskIsFullStayReadable) {
  const Folder folder;
  const rlim_t limit = 200'000'000;
  const pid_t child = start([&] {
    const rlimit bytes{limit, limit};
    setrlimit(RLIMIT_FSIZE, &bytes);
    try {
      record_for_ever(folder / "a.h5");
    } catch (const std::runtime_error&) {
    }
    return 3;
  });
  const int status = status_of(child);
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_EQ(WEXITSTATUS(status), 3);
  const Recording recording(folder / "a.h5.part");
  EXPECT_FALSE(recording.complete());
  EXPECT_GE(recording.frames() * kManyBodies * 48, limit / 2);  // a commit each 64 MB
  expect_all_frames_right(recording);
}

}  // namespace
}  // namespace throng
