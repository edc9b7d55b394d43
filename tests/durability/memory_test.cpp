// SPDX-License-Identifier: MIT
// H6: too little memory ends a run with a sentence, and with a recording that is whole or under its other
// name.
#include <gmock/gmock.h>

#include "tests/durability/durable_run.h"

namespace throng {
namespace {

class Memory : public DurableRun {};

constexpr bool kLimitsWork = !kSanitized;  // else the sanitizer itself takes terabytes of addresses

TEST_F(Memory, H6TooLittleOfItEndsInASentenceAndLeavesNothingHalfMade) {
  const std::string scene = write("a.toml", kHeap);
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

}  // namespace
}  // namespace throng
