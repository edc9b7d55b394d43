// SPDX-License-Identifier: MIT
// What throng bench soft reads of LAMMPS.
#include "tools/bench/peers/lammps.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace throng::bench
