// SPDX-License-Identifier: MIT
// H6: too little memory ends a run with a sentence, and with a recording that is whole or under its other
// name.
#include <gmock/gmock.h>

#include "tests/durability/durable_run.h"

namespace throng {
namespace {

class Memory : public DurableRun, public ::testing::WithParamInterface<Recorded> {};

constexpr bool kLimitsWork = !kSanitized;  // else the sanitizer itself takes terabytes of addresses

TEST_P(Memory, H6TooLittleOfItEndsInASentenceAndLeavesNothingHalfMade) {
  const std::string scene = write("a.toml", heap(GetParam()));
  const std::string run = "run " + scene + " --progress none --force --checkpoint 1000 --until 0.1 ";
  const std::vector<std::uint64_t> whole = reference(scene, "--until 0.1");
  int failed = 0, done = 0;
  for (int megabytes = 60; megabytes < 400 && kLimitsWork; megabytes += 4) {
    SCOPED_TRACE(std::to_string(megabytes) + " MB");
    const std::string file = path("a" + std::to_string(megabytes) + ".h5");
    const Result result = throng(run + "-o " + file, "ulimit -v " + std::to_string(megabytes * 1000) + "; ");
    if (result.exit_code == 127) continue;  // not even the libraries found room
    ASSERT_THAT(result.exit_code, ::testing::AnyOf(0, 1)) << result.err;
    (result.exit_code == 0 ? done : failed) += 1;
    EXPECT_EQ(std::filesystem::exists(file), result.exit_code == 0);
    if (result.exit_code == 0)
      expect_whole(whole, file);
    else
      EXPECT_THAT(result.err, ::testing::StartsWith("throng: "));
  }
  EXPECT_EQ(done > 0 && failed > 0, kLimitsWork) << done << " runs ended, " << failed << " failed";
}

class RefusedMemory : public DurableRun, public ::testing::WithParamInterface<Recorded> {
 protected:
  /// Refuses `owner` one piece after the other, from when the file is made, until that is missed no more.
  /// `each` sees what came of it. Returns how many runs failed.
  template <class Each>
  int refuse_pieces(const std::string& owner, int stride, Each each) {
    const std::string scene = write("a.toml", heap(GetParam())), file = path("a.h5");
    const std::vector<std::uint64_t> whole = reference(scene, "--until 0.1");
    int failed = 0, in_a_row = 0;  // that nobody missed
    for (int n = 1; in_a_row < 30 && kLimitsWork && !HasFailure(); n += full_length() ? 1 : stride) {
      SCOPED_TRACE(owner + "'s piece " + std::to_string(n));
      for (const char* end : {"", ".part", ".ckpt"}) std::filesystem::remove(file + end);
      const Result result =
          throng("run " + scene + " --progress none --force --checkpoint 1000 --until 0.1 -o " + file,
                 "LD_PRELOAD=" THRONG_FAILING_MEMORY " THRONG_FAILING_OWNER=" + owner +
                     " THRONG_FAILING_ALLOCATION=" + std::to_string(n) + " ");
      failed += result.exit_code != 0;
      in_a_row = result.exit_code == 0 ? in_a_row + 1 : 0;
      if (std::filesystem::exists(file)) expect_whole(whole, file);
      expect_sound(whole, file, 0);
      each(result, std::filesystem::exists(file));
    }
    return failed;
  }
};

/// Once the recording is whole the summary takes memory, in nlohmann's destructors too, which end a process
/// that finds none.
TEST_P(RefusedMemory, H6OfTheProgramsOwnEndsInASentenceAndLeavesNothingHalfMade) {
  const int failed = refuse_pieces("throng", 29, [](const Result& result, bool is_whole) {
    if (is_whole) return;
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, ::testing::StartsWith("throng: "));
  });
  EXPECT_EQ(failed > 20, kLimitsWork) << failed << " failed";
}

/// HDF5 1.10.8 itself ends the process in a quarter of these: its clean-up meets what it could not make.
TEST_P(RefusedMemory, H6OfHdf5LeavesNothingHalfMadeHoweverItEnds) {
  int deaths = 0;
  const bool whole = std::string(GetParam().name) == "whole";  // has fewer of them
  const int failed = refuse_pieces("hdf5", whole ? 89 : 211, [&](const Result& result, bool is_whole) {
    deaths += result.exit_code != 0 && !result.err.starts_with("throng: ");
    EXPECT_EQ(result.exit_code == 0, is_whole) << result.err;
  });
  RecordProperty("deaths", deaths);
  EXPECT_EQ(failed > 20, kLimitsWork) << failed << " failed";
}

INSTANTIATE_TEST_SUITE_P(Any, RefusedMemory, ::testing::ValuesIn(kRecorded),
                         [](const auto& one) { return std::string(one.param.name); });

INSTANTIATE_TEST_SUITE_P(Any, Memory, ::testing::ValuesIn(kRecorded),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace throng
