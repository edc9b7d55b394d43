// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/recording/recorder.h"
#include "sim/simulation.h"

namespace CLI {
class App;
}

/// What `throng run` and `throng resume` have in common: steps, frames, checkpoints, signals, the summary.
namespace throng::tools {

/// How a run is to go; none of it changes a bit of the result.
struct DriveOptions {
  int threads = 1;
  std::string progress = "auto";
  std::optional<double>
      checkpoint;  ///< s of wall time from one checkpoint to the next; absent: at a stop alone
  bool checkpoint_at_end = false;  ///< all the same: the one that is there would be of an earlier state
};

/// Declares --threads, --checkpoint and --progress.
void add_drive_options(CLI::App& command, DriveOptions& options);

/// Frames that the recording holds already: what is computed again must agree with them.
struct RecordedFrames {
  std::vector<std::int64_t> steps;  ///< ascending
  std::vector<std::uint64_t> state_hashes;
};

/// Says on the standard error where nobody can know whether the recording has room.
void warn_of_room(const std::string& output, const Scene& scene, const Provenance& provenance);

/// Says on the standard error where checkpoints are asked for that this engine can't go on from.
void warn_of_checkpoints(const DriveOptions& options, const Scene& scene);

/// Says on the standard error where the last state won't be recorded: a longer run, to which this one may be
/// resumed, has no frame there either.
void warn_of_last_state(const Scene& scene);

/// Says on the standard error where threads are asked for that have nothing to do.
void warn_of_threads(const DriveOptions& options, const Scene& scene);

/// Says on the standard error what dt = "auto" was chosen for, where it was.
void say_promise(const Scene& scene);

/// From now on SIGINT and SIGTERM end `drive` in good order, and so does one that comes again: `timeout` and
/// batch systems send theirs to the process and to its group.
void stop_on_signals();
bool stop_requested();

/// Steps from where `simulation` is to the end of the scene or to a signal, and closes the recording with a
/// checkpoint where one was asked for or the run was stopped. Prints the summary; returns the exit code.
/// Frames that are `recorded` are compared instead of added. Throws SimulationError where one differs, naming
/// the step.
int drive(Simulation& simulation, const Scene& scene, const DriveOptions& options, Recorder* recorder,
          const RecordedFrames& recorded = {});

}  // namespace throng::tools
