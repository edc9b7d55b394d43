// SPDX-License-Identifier: MIT
// throng run and throng plan, run as their users run them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

namespace throng {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const char* const kDrop = R"(throng = 1
name = "drop"
gravity = [0, -10]
time = { dt = 0.01, until = 1.0 }
domain = { box = [[-5, 0], [5, 9]] }
[shapes]
ball = { disc = { radius = 0.5 } }
[[bodies]]
shape = "ball"
at = [0, 2]
[[bodies]]
shape = "ball"
at = [0.3, 4]
)";

const char* const kRunaway = R"(throng = 1
name = "runaway"
gravity = [0, 1e8]
time = { dt = 1, until = 1000, substeps = 1 }
[shapes]
ball = { disc = { radius = 0.5 } }
[[bodies]]
shape = "ball"
at = [0, 2]
)";

const char* const kTwoDiscs = R"(throng = 1
engine = "event_driven"
time = { dt = 1, until = 8, substeps = 3 }
domain = { box = [[0, 0], [10, 10]] }
[materials.default]
restitution = 1
friction = 0
[shapes]
ball = { disc = { radius = 0.5 } }
[[bodies]]
shape = "ball"
at = [2, 5]
velocity = [1, 0]
[[bodies]]
shape = "ball"
at = [5, 5]
)";

class RunCommand : public Program {};
class PlanCommand : public Program {};

TEST_F(RunCommand, PrintsOneObjectWithTheKeysOfTheContract) {
  const Result result = throng("run " + write("a.toml", kDrop));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json summary = json::parse(result.out);
  for (const char* key : {"scenario", "engine", "steps", "time", "bodies", "agents", "wall_s", "step_ms",
                          "step_ms_last", "stages", "hash", "max_overlap", "mean_overlap", "kinetic_energy",
                          "potential_energy", "momentum", "contacts", "output"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_EQ(summary["steps"], 100);
  EXPECT_EQ(summary["output"], nullptr);
  const std::string hash = summary["hash"];
  EXPECT_EQ(hash.size(), 16u);
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos) << hash;
}

/// It happened: a crowd that walks was said to have no energy, no momentum and no contacts.
TEST_F(RunCommand, SaysOfACrowdWhatItHasAndNothingOfMechanics) {
  const json summary =
      json::parse(throng("run " THRONG_SOURCE_DIR "/scenarios/circle_swap.toml --until 1").out);
  for (const char* key : {"kinetic_energy", "potential_energy", "momentum", "contacts"}) {
    ASSERT_TRUE(summary.contains(key)) << key;
    EXPECT_TRUE(summary[key].is_null()) << key;
  }
  EXPECT_TRUE(summary["max_overlap"].is_number());
}

TEST_F(RunCommand, CountsWhoSleepsWhereAnybodyMay) {
  const std::string rest =
      "throng = 1\ngravity = [0, -9.81]\ntime.until = 1\ndomain.box = [[0, 0], [9, 9]]\n"
      "shapes.ball.disc.radius = 0.5\n[[bodies]]\nshape = 'ball'\nat = [2, 0.5]\n"
      "[[bodies]]\nshape = 'ball'\nat = [5, 8]\n";
  const Result sleeping = throng("run " + write("rest.toml", rest));
  ASSERT_EQ(sleeping.exit_code, 0) << sleeping.err;
  EXPECT_EQ(json::parse(sleeping.out)["asleep"], 1);
  EXPECT_TRUE(json::parse(sleeping.out)["stages"].contains("sleep"));
  const Result awake = throng("run --set sleep=false " + path("rest.toml"));
  EXPECT_FALSE(json::parse(awake.out).contains("asleep"));
}

TEST_F(RunCommand, NamesASceneWithoutANameAfterItsFile) {
  std::string text = kDrop;
  text.erase(text.find("name"), text.find("gravity") - text.find("name"));
  const Result result = throng("run --until 0 " + write("dropped ball.toml", text).insert(0, "'") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["scenario"], "dropped ball");
}

TEST_F(RunCommand, HashesTheSameWithAndWithoutRecordingAndForAnyNumberOfThreads) {
  const std::string scene = write("a.toml", kDrop);
  const auto hash = [&](const std::string& options) {
    return json::parse(throng("run " + scene + options).out)["hash"];
  };
  const auto plain = hash("");
  EXPECT_EQ(hash(" --threads 2"), plain);
  EXPECT_EQ(hash(" -o " + path("a.h5")), plain);
  EXPECT_EQ(hash(" --every 7 -o " + path("b.h5")), plain);
  EXPECT_NE(hash(" --dt 0.005"), plain);
}

TEST_F(RunCommand, HashesTheSameOnAProcessorWithoutFmaAndInAnyLocale) {
  const std::string arguments = std::string("run --until 0.5 ") + THRONG_SOURCE_DIR + "/scenarios/mixed.toml";
  const auto hash = [&](const std::string& before) {
    return json::parse(throng(arguments, before).out)["hash"];
  };
  const auto plain = hash("");
  EXPECT_EQ(hash("GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable "), plain);
  EXPECT_EQ(hash("LC_ALL=de_DE.UTF-8 MALLOC_PERTURB_=165 "), plain);
}

TEST_F(RunCommand, OptionsAreFieldsOfTheScenario) {
  const Result result = throng("run " + write("a.toml", kDrop) +
                               " --until 0.1 --dt 0.02 --set bodies.0.velocity=[1,0] --set gravity=[0,0]");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary["steps"], 5);
  EXPECT_NEAR(summary["momentum"][0].get<double>(), 0.785398, 1e-6);
}

TEST_F(RunCommand, RecordsWhatReplayThenVerifies) {
  const std::string scene = write("a.toml", kDrop), recording = path("a.h5");
  ASSERT_EQ(throng("run " + scene + " --every 10 -o " + recording).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(recording + ".part"));
  const Result verified = throng("replay --verify " + recording);
  EXPECT_EQ(verified.exit_code, 0) << verified.err;
  EXPECT_THAT(verified.out + verified.err, HasSubstr("11"));
}

TEST_F(RunCommand, SaysThatSubstepsMeanNothingToAnEngineOfTheCommandLine) {
  std::string text = kTwoDiscs;
  const std::string engine = "engine = \"event_driven\"\n";
  text.erase(text.find(engine), engine.size());
  const std::string run = "run " + write("a.toml", text) + " --engine event_driven";
  const Result plain = throng(run);
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_THAT(plain.err, HasSubstr("time.substeps: has no meaning"));
  EXPECT_THAT(throng(run + " --set time.substeps=2").err, HasSubstr("time.substeps: has no meaning"));
}

TEST_F(RunCommand, WantsANameForItsRecording) {  // as of a shell's variable that isn't set
  const Result result = throng("run " + write("a.toml", kTwoDiscs) + " -o ''");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--output: needs a name"));
  EXPECT_EQ(result.out, "");
}

TEST_F(RunCommand, SaysThatTheLastStateIsNotRecorded) {
  const std::string scene = write("a.toml", kTwoDiscs), to = " --force -o " + path("a.h5");
  const std::string run = "run " + scene + to;
  EXPECT_THAT(throng(run + " --every 3").err, HasSubstr("the last frame is of step 6 of 8"));
  EXPECT_THAT(throng(run + " --every 100").err, HasSubstr("the last frame is of step 0 of 8"));
  EXPECT_THAT(throng(run + " --every 100 --dry-run").err, HasSubstr("of step 0 of 8"));
  EXPECT_THAT(throng(run + " --every 4").err, Not(HasSubstr("last frame")));
  EXPECT_THAT(throng(run + " --every 3 --set record.observables=4").err, Not(HasSubstr("last frame")));
  EXPECT_THAT(throng("run " + scene + " --every 3").err, Not(HasSubstr("last frame"))) << "none is asked for";
}

TEST_F(RunCommand, SaysWhereThreadsMeanNothing) {
  const std::string discs = write("a.toml", kTwoDiscs), idle = "--threads has no meaning";
  EXPECT_THAT(throng("run " + discs + " --threads 2").err, HasSubstr(idle));
  EXPECT_THAT(throng("run " + discs).err, Not(HasSubstr(idle)));
  const std::string native = "run " + discs + " --engine native --dt 0.001 --until 0.01";
  EXPECT_THAT(throng(native + " --threads 2").err, Not(HasSubstr(idle)));
  const Result soft = throng(native + " --set 'contact={model=\"spring\", stiffness=1e5}' --threads 2");
  EXPECT_THAT(soft.err, HasSubstr(idle));
  EXPECT_EQ(soft.exit_code, 0) << soft.err;
}

TEST_F(RunCommand, TellsWhatTheCollisionsOfHardDiscsSayOfThem) {
  const std::string scene = write("a.toml", kTwoDiscs);
  const Result result = throng("run " + scene);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("time.substeps: has no meaning"));
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary["engine"], "event_driven");
  EXPECT_EQ(summary["collisions"], 1);
  EXPECT_EQ(summary["wall_collisions"], 1);
  EXPECT_NEAR(summary["temperature"].get<double>(), 0.7853981633974483 / 4, 1e-15);  // m / 2 over two discs
  EXPECT_NEAR(summary["compressibility_factor"].get<double>(), 1 + 1.0 / 8,
              1e-14);  // m v 1 m, over m v^2 8 s
  const json cooled = json::parse(throng("run " + scene + " --set materials.default.restitution=0.5").out);
  EXPECT_EQ(cooled["compressibility_factor"], nullptr);
  const json native = json::parse(throng("run " + scene + " --engine native").out);
  EXPECT_EQ(native["collisions"], 1) << "these fly from collision to collision, too";
  EXPECT_NEAR(native["compressibility_factor"].get<double>(), 1 + 1.0 / 8, 1e-14);
  EXPECT_FALSE(json::parse(throng("run " + scene + " --engine native --set gravity=[0,-1]").out)
                   .contains("collisions"));
}

TEST_F(RunCommand, StopsWhereHardDiscsComeToRestAndRefusesThoseThatOverlap) {
  const std::string scene = write("a.toml", kTwoDiscs);
  const Result rest =
      throng("run " + scene + " --set gravity=[0,-10] --set materials.default.restitution=0.5");
  EXPECT_EQ(rest.exit_code, 1);
  EXPECT_THAT(rest.err, HasSubstr("inelastic collapse"));
  const Result overlap = throng("run " + scene + " --set bodies.1.at=[2.9,5]");
  EXPECT_EQ(overlap.exit_code, 2);
  EXPECT_THAT(overlap.err, HasSubstr("body 1 and body 2 by 0.1 m: hard discs can't"));
}

TEST_F(RunCommand, OverwritesOnlyWhenForced) {
  const std::string command = "run " + write("a.toml", kDrop) + " -o " + write("a.h5", "precious");
  const Result refused = throng(command);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(read(path("a.h5")), "precious");
  EXPECT_EQ(throng(command + " --force").exit_code, 0);
}

TEST_F(RunCommand, RefusesAnOutputFolderThatDoesNotExist) {
  const Result result = throng("run " + write("a.toml", kDrop) + " -o " + path("nowhere/a.h5"));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("nowhere"));
  EXPECT_FALSE(std::filesystem::exists(path("nowhere")));
}

TEST_F(RunCommand, DryRunWritesNothing) {
  const Result result = throng("run " + write("a.toml", kDrop) + " --dry-run -o " + path("a.h5"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["steps"], 0);
  EXPECT_FALSE(std::filesystem::exists(path("a.h5")));
}

/// A rehearsal must find what would stop the run hours later, and must leave no trace.
TEST_F(RunCommand, DryRunChecksTheOutputWithoutMakingIt) {
  const std::string dry = "run --dry-run " + write("a.toml", kDrop) + " -o ";
  EXPECT_EQ(throng(dry + path("no/such/a.h5")).exit_code, 2);
  const Result exists = throng(dry + write("a.h5", "precious"));
  EXPECT_EQ(exists.exit_code, 2);
  EXPECT_THAT(exists.err, HasSubstr("--force"));
  EXPECT_EQ(throng(dry + path("a.h5") + " --force").exit_code, 0);
  const Result full = throng(dry + path("b.h5") + " --until 1e9");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_THAT(full.err, HasSubstr("MB left"));
  write("c.h5.part", "frames of an earlier run");
  EXPECT_EQ(throng(dry + path("c.h5")).exit_code, 2);
  EXPECT_EQ(read(path("a.h5")), "precious");
  EXPECT_EQ(read(path("c.h5.part")), "frames of an earlier run");
  EXPECT_FALSE(std::filesystem::exists(path("a.h5.part")));
  EXPECT_FALSE(std::filesystem::exists(path("b.h5.part")));
}

TEST_F(RunCommand, ARunThatBreaksDownNamesStepAndBodyAndKeepsItsFrames) {
  const std::string scene = write("a.toml", kRunaway);
  const Result result = throng("run " + scene + " -o " + path("a.h5"));
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("step 142"), HasSubstr("body 1"), HasSubstr("throng run " + scene)));
  EXPECT_FALSE(std::filesystem::exists(path("a.h5")));
  const Result info = throng("info --json " + path("a.h5.part"));
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(json::parse(info.out)["frames"], 142);
}

TEST_F(RunCommand, AStoppedRunClosesItsFileAndNamesIt) {
  const std::string run = "run " + write("a.toml", kDrop) + " --until 1e6 --every 1000 -o ";
  for (const std::string signal : {"INT", "TERM"}) {
    const std::string part = path(signal + ".h5.part");
    const Result result =
        throng(run + path(signal + ".h5"), "timeout --preserve-status -s " + signal + " 2 ");
    ASSERT_EQ(result.exit_code, 130) << signal << result.err;
    EXPECT_THAT(result.err, HasSubstr("stopped by a signal"));
    EXPECT_THAT(result.err, HasSubstr(part + " holds the frames so far, closed and readable"));
    const json summary = json::parse(result.out);
    EXPECT_EQ(summary["output"], part);
    EXPECT_FALSE(std::filesystem::exists(path(signal + ".h5")));
    EXPECT_EQ(json::parse(throng("info --json " + part).out)["frames"],
              summary["steps"].get<int>() / 1000 + 1);
    const Result verified = throng("replay --verify " + part);
    EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  }
}

/// `timeout` and batch systems send a signal to the process and to its group: a run that took the second for
/// impatience died with its file open, now and then.
TEST_F(RunCommand, ASignalIsHeardWithinAStepOfManyCollisions) {
  const Result result =
      throng("run " + write("a.toml", kTwoDiscs) + " --dt 1e6 --until 2e6 --set bodies.0.velocity=[1000,0]",
             "timeout --preserve-status -k 20 -s INT 1 ");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("stopped by a signal after step 0 of 2"));
  EXPECT_EQ(json::parse(result.out)["collisions"], 0);
}

TEST_F(RunCommand, ASignalThatComesAgainStopsItOnce) {
  const std::string script =
      write("again.sh", "\"$@\" & run=$!; sleep 2; kill -TERM $run; sleep 0.05; kill -TERM $run; wait $run");
  const std::string slow_steps =
      THRONG_SOURCE_DIR "/scenarios/pyramid.toml --substeps 100 --until 1e6 --every 1000";
  const Result result = throng("run " + slow_steps + " -o " + path("a.h5"), "sh " + script + " ");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("a.h5.part holds the frames so far, closed and readable"));
}

TEST_F(RunCommand, NeverWritesOverItsScenario) {
  const std::string scene = write("a.toml", kDrop);
  const Result result = throng("run " + scene + " --force -o " + path("./a.toml"));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("it is the scenario"));
  EXPECT_EQ(read(scene), kDrop);
}

/// The sentence is there to be pasted into a shell.
TEST_F(RunCommand, TheCommandThatReproducesAFailureIsOneThatAShellUnderstands) {
  const std::string scene = write("it's a scene.toml", kRunaway);
  const Result result = throng("run \"" + scene + "\" --set 'name=\"it'\\''s\"'");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const std::size_t at = result.err.find("throng run ");
  ASSERT_NE(at, std::string::npos) << result.err;
  const std::size_t end = result.err.find('\n', at);
  const Result again = throng(result.err.substr(at + 7, end - at - 7));
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_EQ(again.err.substr(again.err.find("throng:")), result.err.substr(result.err.find("throng:")));
}

TEST_F(RunCommand, NamesARecordingAfterAFileWhoseNameIsNoUtf8) {
  std::string text = kDrop;
  text.erase(text.find("name"), text.find("gravity") - text.find("name"));
  ASSERT_EQ(throng("run --until 0.1 " + write("caf\xe9.toml", text) + " -o " + path("a.h5")).exit_code, 0);
  EXPECT_EQ(throng("replay --verify " + path("a.h5")).exit_code, 0);
}

/// File names are bytes: a run of a Latin-1 name once made a recording that nobody could read.
TEST_F(RunCommand, TakesFileNamesThatAreNoUtf8) {
  const std::string scene = write("caf\xe9.toml", kDrop);
  const Result result = throng("run --until 0.1 " + scene + " -o " + path("caf\xe9.h5"), "USER=Ren\xe9 ");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(json::parse(result.out)["output"].get<std::string>(), HasSubstr("caf\xEF\xBF\xBD.h5"));
  const Result info = throng("info --json " + path("caf\xe9.h5"));
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(json::parse(info.out)["command_line"].get<std::string>(), HasSubstr("caf\xEF\xBF\xBD.toml"));
}

TEST_F(RunCommand, RefusesABadScenarioWithAllItsFaults) {
  const Result result =
      throng("run " + write("a.toml", std::string(kDrop) + "colour = \"red\"\nspin = \"fast\"\n"));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("a.toml:14:"), HasSubstr("a.toml:15:")));
  EXPECT_EQ(result.out, "");
}

TEST_F(RunCommand, RefusesUnknownOptionsAndValues) {
  const std::string scene = write("a.toml", kDrop);
  for (const char* options :
       {" --thread 2", " --threads 0", " --threads two", " --progress loud", " --dt fast", " --dt nan",
        " --engine havok", " --set", " --set nonsense", " --every 0", " --substeps 1.5"})
    EXPECT_EQ(throng("run " + scene + options).exit_code, 2) << options;
}

TEST_F(PlanCommand, SaysWhichStagesRunAndWhy) {
  const Result text = throng("plan " + write("a.toml", kDrop));
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, AllOf(HasSubstr("find_pairs"), HasSubstr("skipped"), HasSubstr("2 dynamic")));
  const Result object = throng("plan --json " + path("a.toml"));
  const json plan = json::parse(object.out);
  EXPECT_EQ(plan["bodies"], 2);
  EXPECT_EQ(plan["stages"].size(), 17u);
  EXPECT_TRUE(plan["ways"].is_null()) << "nobody walks";
  EXPECT_GT(plan["output_bytes"], 0);
}

TEST_F(PlanCommand, SaysWhatTheWaysOfACrowdTake) {
  const std::string scene = THRONG_SOURCE_DIR "/scenarios/corridor.toml";
  EXPECT_THAT(throng("plan " + scene).out,
              testing::ContainsRegex("\nways: 1 distance field on 1 floor plan, [0-9.]+ [kM]B\n"));
  const json ways = json::parse(throng("plan --json " + scene).out)["ways"];
  EXPECT_EQ(ways["fields"], 1);
  EXPECT_EQ(ways["plans"], 1);
  EXPECT_GT(ways["bytes"], 1000);
}

TEST_F(PlanCommand, TakesTheOptionsOfARun) {
  const std::string plan = "plan --json " + write("a.toml", kDrop);
  const json planned =
      json::parse(throng(plan + " --dt 0.1 --until 2 --substeps 1 --every 5 --engine box2d").out);
  EXPECT_EQ(planned["steps"], 20);
  EXPECT_EQ(planned["frames"], 5);
  EXPECT_EQ(planned["substeps"], 1);
  EXPECT_EQ(planned["engine"], "box2d");
}

/// It happened: "1 substeps", and substeps of agents and of what has no time step.
TEST_F(PlanCommand, SpeaksOfSubstepsWhereThereAreAny) {
  EXPECT_THAT(throng("plan --substeps 1 " + write("a.toml", kDrop)).out,
              HasSubstr("steps of 0.01 s in 1 substep of h = 0.01 s\n"));
  const auto without = [&](const std::string& scene) {
    EXPECT_THAT(throng("plan " + scene).out, testing::ContainsRegex("steps of [0-9.]+ s\n")) << scene;
    EXPECT_TRUE(json::parse(throng("plan --json " + scene).out)["substeps"].is_null()) << scene;
  };
  without(write("gas.toml", kTwoDiscs));
  without(THRONG_SOURCE_DIR "/scenarios/corridor.toml");
}

/// It happened: three times what they took, and of those who come and go nobody said that others are fewer.
TEST_F(PlanCommand, ForetellsTheSizeOfSmallAndSparseRecordings) {
  const std::string folder = THRONG_SOURCE_DIR "/scenarios/", file = path("a.h5");
  for (const char* name : {"cradle", "billiard", "circle_swap", "corridor"}) {
    const std::string run = folder + name + ".toml --until 2";
    ASSERT_EQ(throng("run --force " + run + " -o " + file).exit_code, 0);
    const double takes = static_cast<double>(std::filesystem::file_size(file)),
                 planned = json::parse(throng("plan --json " + run).out)["output_bytes"];
    EXPECT_NEAR(planned / takes, 1.0, 0.2) << name;
  }
  // It happened: chunks that are begun, and where bodies come and go their index, were not counted.
  for (const char* run : {"corridor.toml --until 5", "crossing.toml --until 5 --set record.observables=5"}) {
    ASSERT_EQ(throng("run --force " + (folder + run) + " -o " + file).exit_code, 0);
    const double takes = static_cast<double>(std::filesystem::file_size(file)),
                 planned = json::parse(throng("plan --json " + (folder + run)).out)["output_bytes"];
    EXPECT_NEAR(planned / takes, 1.0, 0.02) << run;
  }
  EXPECT_THAT(throng("plan " + folder + "corridor.toml").out,
              HasSubstr(" if all are there from the first to the last\n"));
  EXPECT_THAT(throng("plan " + write("a.toml", kDrop)).out,
              testing::ContainsRegex("101 frames, about [0-9.]+ kB\n"));
}

/// A guess of its own once forgot that single precision holds for all fields.
TEST_F(PlanCommand, ForetellsTheSizeOfTheRecording) {
  const std::string scene = write("a.toml", R"(throng = 1
name = "many"
time = { dt = 0.01, until = 0.5 }
[shapes]
ball = { disc = { radius = 0.4 } }
[[bodies]]
shape = "ball"
place = { lattice = { origin = [0, 0], spacing = [1, 1], size = [20, 20] } }
)");
  for (const std::string precision : {"double", "single"}) {
    const std::string options = " --set 'record={precision=\"" + precision +
                                "\",fields=[\"position\",\"angle\",\"velocity\",\"spin\"]}'";
    const std::string file = path(precision + ".h5");
    const Result planned = throng("plan --json " + scene + options);
    ASSERT_EQ(planned.exit_code, 0) << planned.err;
    ASSERT_EQ(throng("run " + scene + options + " -o " + file).exit_code, 0);
    const auto size = static_cast<double>(std::filesystem::file_size(file));
    EXPECT_NEAR(json::parse(planned.out)["output_bytes"].get<double>(), size, 0.2 * size) << precision;
  }
}

class AnyCommand : public Program {};

/// It happened: results were lost on a full disk, and the exit code said that all was well.
TEST_F(AnyCommand, FailsWhereItsAnswerCannotBeWritten) {
  const std::string scene = write("a.toml", kDrop), recording = path("a.h5"),
                    pair =
                        write("a.jsonl", R"({"a": {"disc": {"radius": 1}}, "b": {"disc": {"radius": 1}}})");
  ASSERT_EQ(throng("run " + scene + " -o " + recording).exit_code, 0);
  for (const std::string& command :
       {"run " + scene, "plan " + scene, "info " + recording, "replay " + recording,
        "query " + scene + " --point 0,0 --nearest 1", "pairs " + pair, std::string("--help")}) {
    const std::string line = THRONG_PROGRAM " " + command + " >/dev/full 2>" + path("err");
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 1) << command;
    EXPECT_THAT(read(path("err")), HasSubstr("cannot write to the standard output: No space left"))
        << command;
  }
}

}  // namespace
}  // namespace throng
