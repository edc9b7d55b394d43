// SPDX-License-Identifier: MIT
#include "tools/replace_file.h"

#include <gmock/gmock.h>

#include <csignal>

#include "tests/tools/program.h"

namespace throng {
namespace {

using testing::ElementsAre;
using tools::replace_file;

struct ReplaceFile : Program {
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(path("")))
      all.push_back(entry.path().filename());
    return all;
  }
};

TEST_F(ReplaceFile, LeavesWhatWasThereWhereASignalEndsTheProgram) {
  const std::string output = write("out", "precious");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto interrupted = [&] {
      replace_file(output, [&](const std::string& name) {
        std::ofstream(name) << "half";
        raise(signal);
      });
    };
    EXPECT_EXIT(interrupted(), testing::ExitedWithCode(130), "");
    EXPECT_THAT(names(), ElementsAre("out"));
    EXPECT_EQ(read(output), "precious");
  }
}

TEST_F(ReplaceFile, GoesOnWhereASignalIsIgnored) {
  const std::string output = path("out");
  const auto before = std::signal(SIGHUP, SIG_IGN);  // as nohup does
  replace_file(output, [&](const std::string& name) {
    raise(SIGHUP);
    std::ofstream(name) << "whole";
  });
  std::signal(SIGHUP, before);
  EXPECT_THAT(names(), ElementsAre("out"));
  EXPECT_EQ(read(output), "whole");
}

TEST_F(ReplaceFile, GivesTheSignalsBack) {
  replace_file(path("out"), [&](const std::string& name) { std::ofstream(name) << "whole"; });
  EXPECT_EXIT(raise(SIGTERM), testing::KilledBySignal(SIGTERM), "");
}

TEST_F(ReplaceFile, KnowsOneFileByItsNames) {
  const std::string file = write("a", "");
  std::filesystem::create_symlink(file, path("link"));
  std::filesystem::create_hard_link(file, path("hard"));
  for (const std::string other : {"a", "./a", "link", "hard"})
    EXPECT_TRUE(tools::are_one_file(file, path(other))) << other;
  EXPECT_FALSE(tools::are_one_file(file, path("b")));
  EXPECT_TRUE(tools::are_one_file("no-such-file", "./no-such-file"));
  // It happened: two names that no file can have counted as one.
  EXPECT_FALSE(tools::are_one_file(path(std::string(300, 'a')), path(std::string(300, 'b'))));
}

}  // namespace
}  // namespace throng
