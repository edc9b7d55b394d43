// SPDX-License-Identifier: MIT
// A run on a disk that fails, once at every write.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

namespace throng {
namespace {

using ::testing::HasSubstr;

class FailingDisk : public Program {};

/// Frames that were committed when the end failed were once removed by the sentence that called them
/// readable.
TEST_F(FailingDisk, EndsARunWithASentenceThatIsTrueOfWhatIsLeft) {
  const std::string scene = THRONG_SOURCE_DIR "/scenarios/cradle.toml";
  const std::string run = "run " + scene + " --until 0.04 --progress none --force -o ";
  int kept = 0, nothing = 0;
  for (int write = 1;; ++write) {
    ASSERT_LT(write, 1000) << "no write fails";
    const std::string file = path("a" + std::to_string(write) + ".h5"), part = file + ".part";
    const Result result =
        throng(run + file, "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" THRONG_FAILING_DISK
                           " THRONG_FAILING_WRITE=" +
                               std::to_string(write) + " ");
    if (result.exit_code == 0) break;
    ASSERT_EQ(result.exit_code, 1) << "write " << write << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr("Input/output error")) << "write " << write;
    EXPECT_FALSE(std::filesystem::exists(file)) << "write " << write;
    const bool left = std::filesystem::exists(part);
    EXPECT_EQ(left, result.err.find("are readable") != std::string::npos) << "write " << write << result.err;
    (left ? kept : nothing) += 1;
    if (!left) continue;
    const Result info = throng("info --json " + part);
    ASSERT_EQ(info.exit_code, 0) << "write " << write << info.err;
    const int frames = nlohmann::json::parse(info.out)["frames"];
    EXPECT_THAT(result.err, HasSubstr("; " + std::to_string(frames) + " frames in it are readable"));
  }
  EXPECT_GT(kept, 0);
  EXPECT_GT(nothing, 10);
}

}  // namespace
}  // namespace throng
