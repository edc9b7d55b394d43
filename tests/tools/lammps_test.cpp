// SPDX-License-Identifier: MIT
// What throng bench soft reads of LAMMPS.
#include "tools/bench/peers/lammps.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/sim/scene_from.h"

namespace throng::bench {
namespace {

const std::string kRun =
    "LAMMPS (29 Sep 2021 - Update 2)\nReading data file ...\n  10000 atoms\nSetting up Verlet run ...\n"
    "Step c_ends \n       0        33514 \n     335        33520 \n"
    "Loop time of 0.5025 on 1 procs for 335 steps with 10000 atoms\n\n"
    "99.9% CPU use with 1 MPI tasks x 1 OpenMP threads\ntouching 16760\nTotal wall time: 0:00:01\n";

TEST(Lammps, TellsHowLongItsStepsTookAndHowManyTouch) {
  const LammpsRun run = read_lammps(kRun);
  EXPECT_EQ(run.fault, "");
  EXPECT_EQ(run.seconds, 0.5025);
  EXPECT_EQ(run.steps, 335.0);
  EXPECT_EQ(run.touching, 16760.0);
}

TEST(Lammps, HasNoFiguresWhereItTellsNone) {
  EXPECT_EQ(read_lammps("").fault, "tells no time");
  EXPECT_EQ(read_lammps(kRun.substr(0, kRun.find("touching"))).fault, "tells no time");
  std::string cut = kRun;
  cut.erase(cut.find("Loop"), 60);
  EXPECT_EQ(read_lammps(cut).fault, "tells no time");
}

TEST(Lammps, SaysWhyItDoesNot) {
  EXPECT_EQ(
      read_lammps("LAMMPS\nERROR: Unrecognized pair style 'gran/hooke/history' (src/force.cpp:275)\nLast\n")
          .fault,
      "ERROR: Unrecognized pair style 'gran/hooke/history' (src/force.cpp:275)");
  EXPECT_EQ(read_lammps("ERROR").fault, "ERROR");
}

/// An environment's variable, until this goes.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before, was_set_ = true;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { was_set_ ? setenv(name_, before_.c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  std::string before_;
  bool was_set_ = false;
};

/// What a bed says of a program lmp that does as the shell is told.
LammpsRun run_of(const std::string& lmp) {
  const ScratchFolder programs;
  std::filesystem::create_directory(programs.path + "/it's a folder");
  std::ofstream(programs.path + "/lmp") << "#!/bin/sh\n" << lmp << '\n';
  std::filesystem::permissions(programs.path + "/lmp", std::filesystem::perms::owner_all);
  const Variable path("PATH", programs.path + ":" + std::getenv("PATH"));
  const Variable folder("TMPDIR", programs.path + "/it's a folder");
  const Scene scene = scene_from(
      "time = { dt = 1e-3, until = 1 }\ncontact = { model = 'spring', stiffness = 1e5 }\ndomain = { box = "
      "[[0, 0], [4, 4]] }\nshapes.ball.disc.radius = 0.5\nbodies = [{ shape = 'ball', at = [2, 2] }]\n");
  return LammpsBed(scene, 1).run();
}

/// It happened: a program that lacked its libraries, which is 127 for the shell too, was "not installed".
TEST(Lammps, SaysThatItIsThereAndFails) {
  EXPECT_EQ(run_of("exit 127").fault, "fails with exit code 127");
  EXPECT_EQ(run_of("echo ERROR: no bed; exit 1").fault, "ERROR: no bed");
  EXPECT_EQ(run_of("exit 124").fault, "takes longer than 600 s");
  EXPECT_EQ(run_of("exit 0").fault, "tells no time");
}

/// It happened: a folder with a quote in its name ended the shell's word.
TEST(Lammps, RunsInItsFolderWhateverItsNameAndWaitsForNobody) {
  const LammpsRun run = run_of("test -f bed.data && test -f bed.lmp && ! read line && printf '" +
                               std::string("Begin\\nLoop time of 2 on 1 procs for 3 steps\\ntouching 4\\n'"));
  EXPECT_EQ(run.fault, "");
  EXPECT_EQ(run.seconds, 2.0);
  EXPECT_EQ(run.steps, 3.0);
  EXPECT_EQ(run.touching, 4.0);
}

}  // namespace
}  // namespace throng::bench
