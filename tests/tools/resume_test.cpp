// SPDX-License-Identifier: MIT
// throng resume, as its users run it.
#include <gmock/gmock.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>

#include "sim/recording/checkpoint.h"
#include "tests/tools/heap.h"
#include "tests/tools/program.h"

namespace throng {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Resume : public Program {
 protected:
  /// Runs the scene to `until` with a checkpoint at its end, as `name`.
  std::string made(const std::string& name, const std::string& until, const std::string& options = "") {
    const Result result =
        throng("run " + write("a.toml", kHeap) + " --progress none --checkpoint 1000 --until " + until +
               " -o " + path(name) + " " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return path(name);
  }
  Result resume(const std::string& arguments) { return throng("resume --progress none " + arguments); }

  /// The recording as one that was killed: under the name that it had then, and not marked as complete.
  static void unfinish(const std::string& file) {
    std::filesystem::rename(file, file + ".part");
    const std::string clear = "/usr/bin/python3 -c \"import h5py; f = h5py.File('" + file +
                              ".part', 'r+', libver='latest'); f['throng/finished'][()] = 0\"";
    ASSERT_EQ(std::system(clear.c_str()), 0);
  }

  /// What h5diff says of two recordings but for the command lines, which differ.
  static int difference(const std::string& a, const std::string& b) {
    return std::system(("h5diff -q --exclude-path /parameters " + a + " " + b).c_str());
  }
};

/// What an engine takes that knows hard discs alone.
const char* const kOnlyDiscs =
    " --set 'shapes.brick={disc={radius=0.4}}' --set materials.default.restitution=1";

TEST_F(Resume, ReachesTheEndOfTheUninterruptedRunBitForBit) {
  const std::string whole = made("whole.h5", "1.0"), part = made("part.h5", "0.4");
  const Result result = resume(part + " --until 1.0 --threads 2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("from the checkpoint at step 40"));
  EXPECT_EQ(json::parse(result.out)["hash"],
            json::parse(throng("run --progress none --until 1 " + path("a.toml")).out)["hash"]);
  EXPECT_EQ(json::parse(result.out)["steps"], 100);
  EXPECT_EQ(json::parse(result.out)["output"], part);
  EXPECT_EQ(difference(whole, part), 0);
  EXPECT_EQ(throng("replay --verify " + part).out, "verified: 101 frames\n");
  EXPECT_FALSE(std::filesystem::exists(part + ".part"));
}

TEST_F(Resume, GoesOnWithAPartThatWasKilled) {
  const std::string whole = made("whole.h5", "1.0"), part = made("part.h5", "0.4", "--every 3");
  unfinish(part);
  for (const std::string& name : {part, part + ".part"}) {
    const Result result = resume(name + " --until 0.7");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(throng("replay --verify " + part).out, "verified: 24 frames\n");
    unfinish(part);
  }
}

TEST_F(Resume, WithoutACheckpointComputesAgainAndChecks) {
  const std::string whole = made("whole.h5", "1.0"), part = made("part.h5", "0.4");
  std::filesystem::remove(part + ".ckpt");
  const Result result = resume(part + " --until 1.0");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("no checkpoint: computing again, and checking, from the start"));
  EXPECT_EQ(difference(whole, part), 0);
}

TEST_F(Resume, ARunWhoseStateCannotBeSavedIsComputedAgainAndChecked) {
  for (const std::string engine : {"box2d", "event_driven"}) {
    const std::string options = "--engine " + engine + (engine == "box2d" ? "" : kOnlyDiscs);
    const std::string whole = made(engine + "_whole.h5", "1.0", options),
                      part = made(engine + "_part.h5", "0.4", options);
    const Result result = resume(part + " --until 1.0");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("computing again, and checking, up to the checkpoint at step 40"));
    EXPECT_EQ(difference(whole, part), 0) << engine;
  }
}

TEST_F(Resume, TakesTheCheckpointBeforeWhereTheLastIsDamagedOrGone) {
  const std::string whole = made("whole.h5", "1.0");
  for (const bool gone : {false, true}) {
    const std::string part = made(gone ? "gone.h5" : "damaged.h5", "0.4"), last = part + ".ckpt";
    ASSERT_EQ(resume(part + " --until 0.6 --checkpoint 1000").exit_code, 0);
    ASSERT_TRUE(std::filesystem::exists(last + ".prev"));
    if (gone)
      std::filesystem::remove(last);
    else
      std::filesystem::resize_file(last, 700);
    const Result result = resume(part + " --until 1.0");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("from the checkpoint at step 40"));
    EXPECT_EQ(result.err.find("it can't be used") == std::string::npos, gone) << result.err;
    EXPECT_EQ(difference(whole, part), 0);
  }
}

TEST_F(Resume, ARunWithoutCheckpointsLeavesOneOnlyWhereItIsStopped) {
  const std::string run = "run --progress none " + write("a.toml", kHeap) + " -o ";
  ASSERT_EQ(throng(run + path("a.h5")).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("a.h5.ckpt")));
  const Result stopped =
      throng(run + path("b.h5") + " --every 1000 --until 1e6", "timeout --preserve-status 1 ");
  ASSERT_EQ(stopped.exit_code, 130);
  EXPECT_THAT(stopped.err, HasSubstr("'throng resume " + path("b.h5") + "' goes on"));
  const std::string steps = json::parse(stopped.out)["steps"].dump();
  const Result again = throng("resume --progress none " + path("b.h5"), "timeout --preserve-status 1 ");
  EXPECT_EQ(again.exit_code, 130) << again.err;
  EXPECT_THAT(again.err, HasSubstr("from the checkpoint at step " + steps));
  EXPECT_GT(json::parse(again.out)["steps"].get<long>(), std::stol(steps));
  EXPECT_EQ(throng("replay --verify " + path("b.h5.part")).exit_code, 0);
}

/// It happened: the checkpoint of a stop outlived the end, and who made the run longer computed all since
/// again.
TEST_F(Resume, ALongerRunGoesOnFromTheEndAlsoWhereAStopLeftTheOnlyCheckpoint) {
  const std::string file = path("a.h5");
  const Result stopped =
      throng("run --progress none " + write("a.toml", kHeap) + " -o " + file + " --every 1000 --until 1e6",
             "timeout --preserve-status 1 ");
  ASSERT_EQ(stopped.exit_code, 130);
  const long step = json::parse(stopped.out)["steps"];
  const auto resume_to = [&](long end) {
    return resume(file + " --until " + std::to_string(0.01 * static_cast<double>(end)));
  };
  ASSERT_EQ(resume_to(step + 20).exit_code, 0);
  const Result longer = resume_to(step + 30);
  EXPECT_EQ(longer.exit_code, 0);
  EXPECT_THAT(longer.err, HasSubstr("from the checkpoint at step " + std::to_string(step + 20)));
}

/// It happened: a step of many collisions, computed again up to the checkpoint, heard no signal.
TEST_F(Resume, ASignalIsHeardWithinAStepThatIsComputedAgain) {
  using Clock = std::chrono::steady_clock;
  const std::string scene = write("a.toml", R"(throng = 1
engine = "event_driven"
time = { dt = 8e3, until = 8e3 }
domain = { box = [[0, 0], [4, 4]] }
materials.default = { restitution = 1, friction = 0 }
shapes.ball.disc.radius = 0.5
bodies = [{ shape = "ball", at = [2, 2], velocity = [1000, 700] }]
)");
  const Clock::time_point start = Clock::now();
  ASSERT_EQ(throng("run --progress none --checkpoint 1000 -o " + path("a.h5") + " " + scene).exit_code, 0);
  const std::chrono::duration<double> step = Clock::now() - start;
  const Result stopped = throng("resume --progress none --until 1.6e4 " + path("a.h5"),
                                "timeout --preserve-status -s INT " + std::to_string(step.count() / 4) + " ");
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_THAT(stopped.err, HasSubstr("computing again, and checking, up to the checkpoint at step 1"));
  EXPECT_EQ(stopped.out, "") << "the step was gone on with: the run began, and told its end";
  EXPECT_EQ(throng("info " + path("a.h5")).exit_code, 0);
}

TEST_F(Resume, SaysThatNothingGoesOnFromCheckpointsOfOtherEngines) {
  const std::string run = "run --progress none --until 0.1 --checkpoint 9 " + write("a.toml", kHeap) + " -o ";
  EXPECT_EQ(throng(run + path("a.h5")).err, "");
  EXPECT_THAT(throng(run + path("b.h5") + " --engine box2d").err,
              HasSubstr("warning: nothing goes on from checkpoints of engine box2d"));
  EXPECT_THAT(resume(path("b.h5") + " --until 0.2 --checkpoint 9").err,
              HasSubstr("warning: nothing goes on from checkpoints of engine box2d"));
}

TEST_F(Resume, MakesCheckpointsAsOftenAsTheRunDidUnlessToldOtherwise) {
  const auto interval = [&](const std::string& file) {
    const std::string command = "/usr/bin/python3 -c \"import h5py; print(h5py.File('" + file +
                                "')['parameters'].attrs['checkpoint'])\" > " + path("interval");
    EXPECT_EQ(std::system(command.c_str()), 0);
    return read(path("interval"));
  };
  const std::string part = made("a.h5", "0.4");
  std::filesystem::remove(part + ".ckpt");
  std::filesystem::remove(part + ".ckpt.prev");
  ASSERT_EQ(resume(part + " --until 0.6").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(part + ".ckpt")) << "the one at the end";
  EXPECT_EQ(interval(part), "1000.0\n");
  ASSERT_EQ(resume(part + " --until 0.7 --checkpoint 500").exit_code, 0);
  EXPECT_EQ(interval(part), "500.0\n");
}

/// It would name a state of another run.
TEST_F(Resume, ANewRunRemovesTheCheckpointsOfTheOneThatItReplaces) {
  const std::string file = made("a.h5", "0.4");
  ASSERT_EQ(resume(file + " --until 0.6 --checkpoint 1000").exit_code, 0);
  ASSERT_EQ(throng("run --progress none --force " + path("a.toml") + " -o " + file).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(file + ".ckpt"));
  EXPECT_FALSE(std::filesystem::exists(file + ".ckpt.prev"));
}

TEST_F(Resume, HasNothingToDoForACompleteRecording) {
  const Result result = resume(made("a.h5", "0.4"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("is complete up to 0.4 s; --until T goes on from there"));
}

TEST_F(Resume, RefusesAnEndBeforeWhatIsRecorded) {
  const Result result = resume(made("a.h5", "0.4") + " --until 0.3");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("has been run to 0.4 s: it can't end before that, at 0.3 s"));
}

/// It happened: where one has a field that the other lacks, unrelated lines were compared.
TEST_F(Resume, RefusesAnotherScenariosCheckpointAndNamesTheField) {
  const std::string part = made("a.h5", "0.4"), other = made("b.h5", "0.4", "--set gravity=[0,-9.81]");
  std::filesystem::copy_file(other + ".ckpt", part + ".ckpt",
                             std::filesystem::copy_options::overwrite_existing);
  const Result result = resume(part + " --until 1");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("is of another scenario than " + part));
  EXPECT_THAT(result.err, HasSubstr(": gravity is [0, -9.81] in the checkpoint, [0, -10] in the recording; "
                                    "remove it to go on from the start, or put the recording's own"));
}

/// The checkpoint of `file` with a change and sound checksums.
void alter_checkpoint(const std::string& file, const std::function<void(Checkpoint&)>& change) {
  const std::string name = recording::checkpoint_path(file);
  Checkpoint checkpoint = recording::read_checkpoint(name);
  change(checkpoint);
  recording::write_checkpoint(name, checkpoint.origin, checkpoint.state);
  std::filesystem::remove(name + ".prev");
}

TEST_F(Resume, RefusesCheckpointsThatBelongElsewhere) {
  const std::string part = made("a.h5", "0.4");
  alter_checkpoint(part, [](Checkpoint& c) { c.origin.frames_hash ^= 1; });
  const Result other = resume(part + " --until 1");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err,
              HasSubstr("belongs to another recording than " + part + ": their first 41 frames differ"));
  alter_checkpoint(part, [](Checkpoint& c) { c.origin.frames_hash ^= 1, c.origin.version = "0.0.9"; });
  const Result old = resume(part + " --until 1");
  EXPECT_EQ(old.exit_code, 2);
  EXPECT_THAT(old.err, HasSubstr("a.h5.ckpt was written by throng 0.0.9, this is "));
  EXPECT_EQ(throng("replay --verify " + part).out, "verified: 41 frames\n");
}

/// A name above the number of bodies is sound in a crowd that others have left, and would be read past the
/// end of the scene's arrays in a scene of bodies.
TEST_F(Resume, RefusesACheckpointOfBodiesThatArrived) {
  const std::string part = made("a.h5", "0.4");
  alter_checkpoint(part, [](Checkpoint& c) {
    c.state.crowd.arrived = 1'000'000;
    c.state.crowd.arrivals.assign(1'000'000, 1);
    c.state.crowd.arrivals.back() = 2;
    c.state.crowd.arrived_id.resize(1'000'000);
    std::iota(c.state.crowd.arrived_id.begin(), c.state.crowd.arrived_id.end(), c.state.id.size() + 1);
    std::swap(c.state.id[0], c.state.crowd.arrived_id.back());
  });
  const Result result = resume(part + " --until 1");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              HasSubstr("a.h5.ckpt remembers 1000000 arrived, but no agents are recorded in " + part));
}

constexpr const char* kCrowd = R"toml(throng = 1
time = { dt = 0.02, until = 6 }
walkable = "POLYGON ((0 0, 9 0, 9 4, 0 4, 0 0))"
areas = { exit = [[8, 0], [9, 0], [9, 4], [8, 4]] }
[[agents]]
count = 30
place = { random = { within = [[0, 0], [9, 4]] } }
model = "collision_free_speed"
goal = "exit"
)toml";

/// Agents have left before the checkpoint, others leave after it.
TEST_F(Resume, LetsACrowdWalkOn) {
  const std::string scene = write("crowd.toml", kCrowd), whole = path("whole.h5"), part = path("part.h5");
  const std::string run = "run --progress none --checkpoint 1000 " + scene;
  ASSERT_EQ(throng(run + " -o " + whole).exit_code, 0);
  ASSERT_EQ(throng(run + " --until 3 -o " + part).exit_code, 0);
  const State state = recording::read_checkpoint(part + ".ckpt").state;
  EXPECT_GT(state.crowd.arrived, 0);
  EXPECT_GT(state.id.size(), 0u);
  const Result result = resume(part + " --until 6");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("from the checkpoint at step 150"));
  EXPECT_EQ(difference(whole, part), 0);
  EXPECT_EQ(throng("replay --verify " + part).out, "verified: 301 frames\n");
}

/// Frames that are there already are the proof that nothing computes otherwise.
TEST_F(Resume, StopsWhereItComputesOtherwiseThanWhatIsRecorded) {
  const std::string part = made("a.h5", "0.4");
  alter_checkpoint(part, [](Checkpoint& c) { c.state.position[0].x() += 1e-9; });
  const Result result = resume(part + " --until 1");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("step 40 gives another state"), HasSubstr("nothing was added")));
  EXPECT_EQ(throng("replay --verify " + part).out, "verified: 41 frames\n");
}

TEST_F(Resume, ComputesDamagedFramesAgain) {
  const std::string part = made("a.h5", "0.4");
  const std::string damage = "/usr/bin/python3 -c \"import h5py; f = h5py.File('" + part +
                             "', 'r+', libver='latest'); f['throng/frames/frame_hash'][7] += 1; "
                             "f['throng/finished'][()] = 0\"";
  ASSERT_EQ(std::system(damage.c_str()), 0);
  const Result result = resume(part + " --until 1");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("frame 7: it does not match its hash"), HasSubstr("follows 41 frames"),
                    HasSubstr("computing again, and checking, from the start")));
  EXPECT_EQ(throng("replay --verify " + part).out, "verified: 101 frames\n");
}

TEST_F(Resume, RefusesAnotherVersionsRecordingAndNamesBoth) {
  const std::string part = made("a.h5", "0.4");
  const std::string forge =
      "/usr/bin/python3 -c \"import h5py, numpy; f = h5py.File('" + part +
      "', 'r+', libver='latest'); f['parameters'].attrs['version'] = numpy.bytes_('0.0.9')\"";
  ASSERT_EQ(std::system(forge.c_str()), 0);
  const Result result = resume(part + " --until 1");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("was written by throng 0.0.9, this is "));
}

/// A crafted one would make a checkpoint each step.
TEST_F(Resume, RefusesAnIntervalOfCheckpointsThatNoRunCanHave) {
  for (const char* interval : {"1e-300", "-1", "float('nan')", "float('inf')"}) {
    const std::string part = made("a.h5", "0.4", "--force");
    const std::string forge = "/usr/bin/python3 -c \"import h5py; f = h5py.File('" + part +
                              "', 'r+', libver='latest'); f['parameters'].attrs.modify('checkpoint', " +
                              interval + ")\"";
    ASSERT_EQ(std::system(forge.c_str()), 0);
    const Result result = resume(part + " --until 1");
    EXPECT_EQ(result.exit_code, 2) << interval;
    EXPECT_THAT(result.err, HasSubstr("is damaged: checkpoint is out of range")) << interval;
  }
}

TEST_F(Resume, SaysWhatIsWrongWithFilesThatItCannotGoOnWith) {
  EXPECT_THAT(resume(path("none.h5")).err, HasSubstr("none.h5 does not exist"));
  const Result text = resume(write("a.h5.part", "no recording"));
  EXPECT_EQ(text.exit_code, 2);
  EXPECT_THAT(text.err, HasSubstr("is no HDF5 file"));
  EXPECT_EQ(read(path("a.h5.part")), "no recording");
}

TEST_F(Resume, RefusesToDisturbARunThatIsGoingOn) {
  const std::string run = "run --progress none " + write("a.toml", kHeap) + " --until 1e6 --every 100 -o " +
                          path("a.h5") + " --checkpoint 0.01";
  const std::string script = write("s.sh", std::string(THRONG_PROGRAM) + " " + run + " & run=$!; sleep 1; " +
                                               THRONG_PROGRAM " resume " + path("a.h5") + "; echo $? >" +
                                               path("code") + "; kill $run; wait $run");
  const Result result = throng("--version", "sh " + script + " 2>" + path("said") + " >/dev/null; ");
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_EQ(read(path("code")), "2\n");
  EXPECT_THAT(read(path("said")), HasSubstr("is still being written by another run"));
  EXPECT_EQ(throng("replay --verify " + path("a.h5.part")).exit_code, 0);
}

TEST_F(Resume, CheckpointsNeedARecording) {
  const Result result = throng("run " + write("a.toml", kHeap) + " --checkpoint 1");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--checkpoint stands beside a recording: give -o too"));
  for (const char* bad : {"0", "-1", "nan", "soon"})
    EXPECT_EQ(throng("run " + path("a.toml") + " -o " + path("a.h5") + " --checkpoint=" + bad).exit_code, 2)
        << bad;
}

}  // namespace
}  // namespace throng
