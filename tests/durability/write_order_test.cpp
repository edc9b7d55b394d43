// SPDX-License-Identifier: MIT
// H2: what a crash at every possible moment leaves, from the log of all writes to a recording.
#include <gmock/gmock.h>

#include <cstring>
#include <fstream>

#include "sim/input_error.h"
#include "sim/recording/h5_read.h"
#include "tests/durability/durable_run.h"

namespace throng {
namespace {

struct Write {
  std::uint64_t at, count;  ///< count ~0: the file's size becomes `at`
  std::string bytes;
};

std::vector<Write> writes_in(const std::string& log) {
  std::vector<Write> all;
  for (std::size_t at = 0; at + 16 <= log.size();) {
    Write write;
    std::memcpy(&write.at, log.data() + at, 8);
    std::memcpy(&write.count, log.data() + at + 8, 8);
    at += 16;
    if (write.count != ~std::uint64_t{0}) write.bytes = log.substr(at, write.count);
    at += write.bytes.size();
    all.push_back(std::move(write));
  }
  return all;
}

/// The first `count` bytes of the write reach the file.
void apply(std::string& file, const Write& write, std::size_t count) {
  if (write.count == ~std::uint64_t{0}) return file.resize(write.at);
  if (file.size() < write.at + count) file.resize(write.at + count);
  file.replace(write.at, count, write.bytes, 0, count);
}

class WriteOrder : public DurableRun, public ::testing::WithParamInterface<Recorded> {
 protected:
  /// Frames that can be read, all of which must be right; -1 where the file is refused.
  int frames_in(const std::string& bytes, const std::vector<std::uint64_t>& whole) {
    write("crashed.h5.part", bytes);
    try {
      const Recording recording(path("crashed.h5.part"));
      Frame frame;
      for (std::size_t i = 0; i < recording.frames(); ++i) {
        recording.read(i, frame);
        EXPECT_EQ(frame.frame_hash, whole.at(i)) << "a wrong frame";
      }
      return static_cast<int>(recording.frames());
    } catch (const InputError&) {
      return -1;
    }
  }
};

TEST_P(WriteOrder, NoCrashBetweenTwoWritesLosesAFrameAndNoneInsideAWriteShowsAWrongOne) {
  const std::string scene = write("a.toml", heap(GetParam())), log = path("log");
  const int steps =
      cases(500, kSanitized ? 250 : 100) * (GetParam().scene == kHeap ? 1 : 2);  // those of agents are quick
  const std::string options = "--substeps 400 --checkpoint 0.001" + GetParam().until(steps);
  const std::vector<std::uint64_t> whole = reference(scene, options);
  const Result result = throng(
      "run " + scene + " --progress none -o " + path("a.h5") + " " + options,
      "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" THRONG_LOGGED_DISK " THRONG_WRITE_LOG=" + log +
          " ");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<Write> writes = writes_in(read(log));
  ASSERT_GT(writes.size(), 100u);

  // a crowd's file is of so many parts that its writes are some thousands
  const std::size_t stride = full_length() ? 1 : 1 + writes.size() / (kSanitized ? 150 : 500);
  std::string file;
  int most = -1, commits = 0, refused_halves = 0;
  for (std::size_t k = 0; k < writes.size() && !HasFailure(); ++k) {
    SCOPED_TRACE("write " + std::to_string(k) + " of " + std::to_string(writes.size()));
    const bool looks = k % stride == 0 || k + 1 == writes.size();
    if (looks && writes[k].bytes.size() > 1) {
      std::string torn = file;
      apply(torn, writes[k], writes[k].bytes.size() / 2);
      refused_halves += frames_in(torn, whole) < most;
    }
    apply(file, writes[k], writes[k].bytes.size());
    if (!looks) continue;
    const int frames = frames_in(file, whole);
    EXPECT_GE(frames, most) << "frames that could be read are lost";
    commits += frames > most;
    most = frames;
  }
  EXPECT_EQ(most, static_cast<int>(whole.size()));
  EXPECT_TRUE(file == read(path("a.h5"))) << "the log is not all that was written";
  EXPECT_GT(commits, 5) << "the sample has too few commits";
  RecordProperty("writes", static_cast<int>(writes.size()));
  RecordProperty("commits", commits);
  RecordProperty("torn_writes_that_cost_frames", refused_halves);
}

INSTANTIATE_TEST_SUITE_P(H2, WriteOrder,
                         ::testing::Values(kRecorded[0], kRecorded[1], kRecorded[2], kRecordedCrowd),
                         [](const auto& one) { return std::string(one.param.name); });

/// Whether the file says that it is complete and lacks who arrived: to readers who look at no more than that,
/// as this is written last, and asks for no hash.
bool lacks_arrivals(const std::string& path, std::size_t arrivals) {
  using namespace recording;
  try {
    h5::prepare();
    const unsigned flags = H5F_ACC_RDONLY | H5F_ACC_SWMR_READ;
    const h5::File file{
        h5::Handle(H5Fopen(path.c_str(), flags, H5P_DEFAULT), H5Fclose, "cannot open the file"), path, true};
    const h5::Handle throng = h5::open_group(file.handle, "throng"), who = h5::open_group(throng, "arrivals");
    return h5::read_array<std::uint64_t>(file, throng, "finished", {})[0] != 0 &&
           (h5::read_array<std::uint32_t>(file, who, "id").size() != arrivals ||
            h5::read_array<std::int64_t>(file, who, "step").size() != arrivals);
  } catch (const h5::Error&) {
    return false;
  }
}

TEST_F(DurableRun, WhoArrivedIsInTheFileBeforeItSaysThatItIsComplete) {
  const std::string log = path("log");
  const std::string scene = write(
      "a.toml",
      "throng = 1\ntime = { dt = 0.02, until = 1 }\nwalkable = 'POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0))'\n"
      "areas.exit = [[8, 0], [9, 0], [9, 9], [8, 9]]\n[[agents]]\nmodel = 'constant_velocity'\ncount = 40\n"
      "radius = 0.1\ngoal = 'exit'\nplace = { random = { within = [[7.2, 0], [8, 9]] } }\n");
  const Result result = throng(
      "run " + scene + " --progress none -o " + path("a.h5"),
      "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" THRONG_LOGGED_DISK " THRONG_WRITE_LOG=" + log +
          " ");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ASSERT_EQ(Recording(path("a.h5")).arrivals().value().id.size(), 40u);
  const std::vector<Write> writes = writes_in(read(log));
  std::string file;
  for (std::size_t k = 0; k < writes.size(); ++k) {
    apply(file, writes[k], writes[k].bytes.size());
    if (k + 40 < writes.size()) continue;
    write("crashed.h5.part", file);
    EXPECT_FALSE(lacks_arrivals(path("crashed.h5.part"), 40)) << "write " << k << " of " << writes.size();
  }
}

}  // namespace
}  // namespace throng
