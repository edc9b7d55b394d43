// SPDX-License-Identifier: MIT
// What throng says to a command line that it doesn't understand.
#include <gmock/gmock.h>

#include "tests/tools/program.h"

namespace throng {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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
  const auto expect_threads = [&](const std::string& given) {
    expect_refused("run " + scene + " --threads " + given,
                   HasSubstr("--threads: must be a whole number from 1 to 256, not '" + given + "'"));
  };
  for (const char* given : {"257", "08000000000000000000000", "two", "1.5", "-3"}) expect_threads(given);
  expect_refused("replay a.h5 --png a.png --width 0199", HasSubstr("from 200 to 8000, not '0199'"));
  expect_refused("export a.h5 --format csv -o - --every 0",
                 HasSubstr("--every: must be a whole number from 1 to "));
}

/// What was typed was once called by CLI11's words, or not at all.
TEST_F(CommandLine, SaysWhatNumbersMayBe) {
  expect_refused("replay a.h5 --png a.png --at x", HasSubstr("--at: 'x' is no number"));
  expect_refused("replay a.h5 --speed 0",
                 HasSubstr("--speed: must be a number from 1e-09 to 1000000000, not '0'"));
  for (const char* given : {"0", "x", "nan", "2e9"})
    expect_refused("run a.toml -o a.h5 --checkpoint " + std::string(given),
                   HasSubstr("--checkpoint: must be a number from 0.001 to 1000000000, not '" +
                             std::string(given) + "'"));
  expect_refused("export a.h5 --format csv -o - --every",
                 HasSubstr("throng: --every: a value is missing; see"));
}

/// It happened: who typed --every 0 was told of a --set that nobody had typed.
TEST_F(CommandLine, FaultsOfOptionsThatAreFieldsAreNamedAsTheyWereTyped) {
  const std::string scene = THRONG_SOURCE_DIR "/scenarios/cradle.toml";
  for (const auto& [option, value, allowed] :
       {std::tuple("--every", "0", "record.every: must be an integer from 1 to 1000000000"),
        std::tuple("--dt", "0", "time.dt: must be a number from 1e-12"),
        std::tuple("--engine", "box3d", "engine: must be one of"),
        std::tuple("--until", "x", "time.until: must be")}) {
    const std::string typed = std::string(option) + " " + value;
    expect_refused("run " + scene + " " + typed, StartsWith(typed + ": error: " + allowed));
  }
  expect_refused("run " + scene + " --set record.every=0", StartsWith("--set record.every=0: error: "));
}

/// Two commands in one call once ran both and told the second's exit code.
/// It happened: "--until .1" was told that it is a string, "--set a b" that b was not expected.
TEST_F(CommandLine, TakesNumbersAndSettingsAsPeopleTypeThem) {
  const std::string run = "run " THRONG_SOURCE_DIR "/scenarios/cradle.toml";
  for (const char* options : {" --until .01 --dt 1.e-3", " --set time.until=.01 --dt .001", " --until +1e-2"})
    EXPECT_EQ(throng(run + options).exit_code, 0) << options;
  for (const char* wrong : {".", "1..2", "-.1"})
    expect_refused(run + " --until " + wrong, HasSubstr("time.until: "));
  expect_refused(run + " --set time.dt 0.1",
                 HasSubstr("--set takes one word, PATH=VALUE as in time.dt=0.005, not 'time.dt' and '0.1'"));
  expect_refused(run + " --set time.dt=1 2", HasSubstr("'2' was not expected"));
}

/// It happened: of --until 2 --set time.until=3 the last one held, whichever came first.
TEST_F(CommandLine, RefusesAnOptionAndASettingOfTheSameField) {
  const std::string run = "run " THRONG_SOURCE_DIR "/scenarios/cradle.toml --progress none ";
  for (const char* options : {"--until 0.2 --set time.until=0.3", "--set time.until=0.3 --until 0.2"})
    expect_refused(run + options,
                   HasSubstr("--until 0.2 and --set time.until=0.3 contradict each other: give one of them"));
  expect_refused(run + "--dt 0.1 --set 'time.dt = 0.2'", HasSubstr("--dt 0.1 and --set time.dt = 0.2 "));
  EXPECT_EQ(throng(run + "--until 0.2 --set time.dt=0.1").exit_code, 0);
  EXPECT_EQ(throng(run + "--set time.until=0.3 --set time.until=0.2").exit_code, 0) << "the last one holds";
}

TEST_F(CommandLine, SaysWhereAGoalIsThatNoWayLeadsTo) {
  const auto scene = [&](const std::string& exit) {
    return write("far.toml",
                 "throng = 1\nwalkable = 'POLYGON ((0 0, 9 0, 9 4, 0 4, 0 0))'\nareas.e = " + exit +
                     "\n[[walls]]\nsegment = [[6, 0], [6, 4]]\n[[agents]]\nat = [5, 2]\nmodel = 'orca'\n"
                     "  goal = 'e'\n");
  };
  for (const char* command : {"validate ", "run --dry-run ", "run "}) {
    expect_refused(command + scene("[[30, 0], [32, 0], [32, 4], [30, 4]]"),
                   HasSubstr("far.toml:3:11: error: areas.e: has nothing in common with the walkable area"));
    expect_refused(command + scene("[[7, 0], [9, 0], [9, 4], [7, 4]]"),
                   HasSubstr("far.toml:9:10: error: agents[0].goal: no way wide enough leads from [5, 2]"));
  }
}

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
