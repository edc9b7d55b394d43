// SPDX-License-Identifier: MIT
// What throng says to a command line that it doesn't understand.
#include <gmock/gmock.h>

#include "tests/tools/program.h"

namespace throng {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class CommandLine : public Program {
 protected:
  void expect_refused(const std::string& arguments, const ::testing::Matcher<std::string>& message) const {
    const Result result = throng(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err, message) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
  }
};

TEST_F(CommandLine, WithoutACommandListsThem) {
  for (const std::string arguments : {"", "--"})
    expect_refused(arguments,
                   AllOf(HasSubstr("a command is missing"), HasSubstr("validate"), HasSubstr("replay")));
}

TEST_F(CommandLine, SuggestsTheCommandThatWasMeant) {
  expect_refused("rn x.toml", HasSubstr("there is no command 'rn', did you mean \"run\"?"));
  expect_refused("fly", AllOf(HasSubstr("there is no command 'fly'"), HasSubstr("validate")));
}

TEST_F(CommandLine, SaysWhatIsWrongAndWhoseHelpSaysMore) {
  expect_refused("run", AllOf(HasSubstr("throng: SCENE is required"), HasSubstr("throng run --help")));
  expect_refused("run a.toml b.toml", AllOf(HasSubstr("'b.toml' was not"), HasSubstr("throng run --help")));
  expect_refused("run a.toml --thread 2", HasSubstr("no option '--thread', did you mean \"--threads\"?"));
  expect_refused("run a.toml --thread=2", HasSubstr("no option '--thread', did you mean \"--threads\"?"));
  expect_refused("run a.toml --threads 0", AllOf(HasSubstr("--threads"), HasSubstr("throng run --help")));
  expect_refused("--fly", AllOf(HasSubstr("--fly"), HasSubstr("throng --help")));
}

/// 010 was once read as 8.
TEST_F(CommandLine, ReadsWholeNumbersInDecimals) {
  const std::string scene = THRONG_SOURCE_DIR "/scenarios/cradle.toml";
  EXPECT_EQ(throng("run " + scene + " --until 0 --threads 010").exit_code, 0);
  expect_refused("run " + scene + " --threads 257", HasSubstr("not in range"));
  expect_refused("run " + scene + " --threads 08000000000000000000000", HasSubstr("out of range"));
  expect_refused("run " + scene + " --threads two", HasSubstr("'two' is no whole number"));
  expect_refused("replay a.h5 --png a.png --width 0199", HasSubstr("not in range"));
}

/// Two commands in one call once ran both and told the second's exit code.
TEST_F(CommandLine, TakesOneCommandACall) {
  const std::string bad = write("bad.toml", "throng = 2\n");
  EXPECT_EQ(throng("validate " + bad + " info a.h5").exit_code, 2);
  EXPECT_EQ(throng("validate plan").exit_code, 2);
  EXPECT_THAT(throng("validate plan").err, HasSubstr("plan: error: there is no such file"));
}

TEST_F(CommandLine, AnswersForHelpAndVersionOnTheStandardOutput) {
  for (const std::string arguments : {"--help", "run --help", "--version"}) {
    const Result result = throng(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments;
    EXPECT_NE(result.out, "") << arguments;
    EXPECT_EQ(result.err, "") << arguments;
  }
}

}  // namespace
}  // namespace throng
