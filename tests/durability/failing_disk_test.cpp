// SPDX-License-Identifier: MIT
// H3: a run on a disk that fails, once at every write, in each way.
#include <gmock/gmock.h>

#include <filesystem>

#include "tests/durability/durable_run.h"

namespace throng {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

struct Failure {
  const char* how;
  const Recorded& recorded;
};

void PrintTo(const Failure& failure, std::ostream* out) {
  *out << failure.how << ' ' << failure.recorded.name;
}

class FailingDisk : public DurableRun, public ::testing::WithParamInterface<Failure> {
 protected:
  std::string scene() const { return write("a.toml", heap(GetParam().recorded)); }
  static std::string failing_at(int write) {
    return std::string("ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" THRONG_FAILING_DISK
                       " THRONG_FAILURE=") +
           GetParam().how + " THRONG_FAILING_WRITE=" + std::to_string(write) + " ";
  }

  /// From one write that fails to the next: a crowd's are hundreds, and sanitizers take long.
  static int stride() {
    const bool crowd = &GetParam().recorded == &kRecordedCrowd;
    return full_length() ? 1 : crowd ? (kSanitized ? 5 : 3) : (kSanitized ? 3 : 1);
  }

  /// Of a resume, whose writes are hundreds, most of them alike.
  static int stride_of_resume() {
    const bool whole = &GetParam().recorded == &kRecorded[0];
    return full_length() ? 1 : (whole ? 2 : 5) * (kSanitized ? 4 : 1);
  }

  /// What must hold after a run that failed. Returns whether frames were kept.
  bool expect_orderly_end(const Result& result, const std::string& file) {
    const std::string part = file + ".part";
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(result.err, AnyOf(HasSubstr("Input/output error"), HasSubstr("No space left on device")));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(std::filesystem::exists(file));
    const bool left = std::filesystem::exists(part);
    EXPECT_EQ(left, result.err.find("are readable") != std::string::npos) << result.err;
    return left;
  }
};

/// Frames that were committed when the end failed were once removed by the sentence that called them
/// readable.
TEST_P(FailingDisk, EndsARunWithASentenceThatIsTrueOfWhatIsLeftAndResumeGoesOnWithIt) {
  const std::string scene = this->scene(),
                    options = GetParam().recorded.until(5) + "--checkpoint 1000 --force";
  const std::vector<std::uint64_t> whole = reference(scene, options);
  int kept = 0, nothing = 0, checkpoints = 0;
  for (int write = 1;; write += stride()) {
    SCOPED_TRACE("write " + std::to_string(write));
    ASSERT_LT(write, 1000) << "no write fails";
    const std::string file = path("a.h5");
    const Result result =
        throng("run " + scene + " --progress none " + options + " -o " + file, failing_at(write));
    if (result.exit_code == 0) {
      expect_whole(whole, file);
      break;
    }
    const bool left = expect_orderly_end(result, file);
    (left ? kept : nothing) += 1;
    checkpoints += std::filesystem::exists(file + ".ckpt");
    if (!left) continue;
    expect_beginning_of(whole, file + ".part");
    EXPECT_THAT(result.err, HasSubstr(std::to_string(Recording(file + ".part").frames())));
    const Result resumed = throng("resume --progress none " + file);
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    expect_whole(whole, file);
    std::filesystem::remove(file);
    std::filesystem::remove(file + ".ckpt");
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(kept, 3);
  EXPECT_GT(nothing, 10);
  // what comes after the checkpoint makes no file longer: a full disk doesn't stop it
  EXPECT_EQ(checkpoints > 0, std::string(GetParam().how) != "full");
}

/// What was there before stays, whatever write fails while it is copied and continued.
TEST_P(FailingDisk, AResumeThatFailsLosesNoFrame) {
  const std::string scene = this->scene(), file = path("a.h5");
  const std::string end = GetParam().recorded.until(6);
  const std::vector<std::uint64_t> whole = reference(scene, end),
                                   half = reference(scene, GetParam().recorded.until(3) + "--checkpoint 1000",
                                                    "half.h5");
  for (int write = 1;; write += stride_of_resume()) {
    SCOPED_TRACE("write " + std::to_string(write));
    ASSERT_LT(write, 1000) << "no write fails";
    std::filesystem::remove(file + ".part");
    for (const char* kind : {"", ".ckpt"})
      std::filesystem::copy_file(path(std::string("half.h5") + kind), file + kind,
                                 std::filesystem::copy_options::overwrite_existing);
    const Result result = throng("resume --progress none --checkpoint 1000 " + end + file, failing_at(write));
    if (result.exit_code == 0) {
      expect_whole(whole, file);
      break;
    }
    ASSERT_EQ(result.exit_code, 1) << result.err;
    expect_whole(half, file);
    EXPECT_FALSE(std::filesystem::exists(file + ".part.new"));
    if (std::filesystem::exists(file + ".part")) expect_beginning_of(whole, file + ".part");
    const Result again = throng("resume --progress none " + end + file);
    ASSERT_EQ(again.exit_code, 0) << again.err;
    expect_whole(whole, file);
  }
}

INSTANTIATE_TEST_SUITE_P(H3, FailingDisk,
                         ::testing::Values(Failure{"eio", kRecorded[0]}, Failure{"enospc", kRecorded[0]},
                                           Failure{"full", kRecorded[0]}, Failure{"once", kRecorded[0]},
                                           Failure{"enospc", kRecorded[1]}, Failure{"eio", kRecorded[2]},
                                           Failure{"full", kRecordedCrowd}, Failure{"once", kRecordedCrowd}),
                         [](const auto& failure) {
                           return std::string(failure.param.how) + "_" + failure.param.recorded.name;
                         });

}  // namespace
}  // namespace throng
