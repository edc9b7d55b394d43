// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "sim/recording/checkpoint.h"
#include "sim/recording/recording.h"

/// What there is to go on from.
namespace throng::tools {

/// The recording to go on with, and how much of it is sound.
struct Kept {
  std::string output;  ///< its final name, OUT.h5
  std::string source;  ///< the file that has it: OUT.h5 or OUT.h5.part
  Recording recording;
  std::size_t frames;  ///< the first so many can be read and match their hashes
};

/// Finds OUT.h5.part, or else OUT.h5, for either name, and reads every frame. Says on stderr where frames at
/// the end are damaged. Throws InputError where there is no recording, another run is writing to it, or
/// another version of throng wrote it.
Kept find_recording(const std::string& name);

/// The later of the two checkpoints that can be read and belongs to the kept frames; none where there is
/// none. Says on stderr why one can't be used. Throws InputError, naming the difference, where one belongs to
/// another recording, scenario or version.
std::optional<Checkpoint> find_checkpoint(const Kept& kept);

}  // namespace throng::tools
