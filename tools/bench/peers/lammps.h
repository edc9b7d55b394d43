// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/scene.h"
#include "tools/bench/scratch_folder.h"

/// LAMMPS, the program `lmp` where it is installed: the granular peer of `throng bench soft`.
namespace throng::bench {

/// What LAMMPS told of a run.
struct LammpsRun {
  double seconds = 0.0;    ///< of its loop over steps, as it takes the time itself
  double steps = 0.0;      ///< of that loop
  double touching = 0.0;   ///< pairs of discs, at the end
  std::string fault = "";  ///< why there are no figures, in a few words; "" where there are
};

/// Reads all of a run's output, of the script that LammpsBed writes.
LammpsRun read_lammps(const std::string& output);

/// A scene's bodies, as they are, on its `gran/hooke/history`: contact model spring, in a box, under gravity.
/// As LAMMPS knows one material and damps by a rate that all pairs share, that of the first and of two of the
/// mean mass. Each run begins anew from the scene, without tangential springs.
class LammpsBed {
 public:
  /// Expects discs alone. Steps are the scene's substeps.
  LammpsBed(const Scene& scene, int steps);

  /// On one core. Where there is no `lmp`, or it can't, or takes over ten minutes, the fault says so.
  LammpsRun run() const;

 private:
  ScratchFolder folder_;
};

}  // namespace throng::bench
