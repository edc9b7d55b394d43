// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "sim/state.h"

/// The file beside a recording from which a run can go on: OUT.h5.ckpt, and the one before as
/// OUT.h5.ckpt.prev.
namespace throng {

/// What a checkpoint belongs to; a run goes on only where all of it still holds.
struct CheckpointOrigin {
  std::string version;            ///< of the throng that wrote it
  std::string scenario;           ///< resolved, as in the recording
  std::uint64_t frames = 0;       ///< that the recording held when the checkpoint was made, all on the disk
  std::uint64_t frames_hash = 0;  ///< recording::chain_hash of their hashes
};

struct Checkpoint {
  CheckpointOrigin origin;
  State state;  ///< complete: stepping on gives the bits that the run itself would have given
};

namespace recording {

std::string checkpoint_path(const std::string& recording);           ///< of OUT.h5: OUT.h5.ckpt
std::string previous_checkpoint_path(const std::string& recording);  ///< OUT.h5.ckpt.prev

/// Makes `state` the checkpoint at `path`; the one that stood there becomes `path`.prev. A crash at any
/// moment, loss of power included, leaves the old one or the new one whole under one of the two names. About
/// a GB/s; allocates 28 bytes a contact. Throws std::runtime_error with path and reason; what stood there
/// then stays.
void write_checkpoint(const std::string& path, const CheckpointOrigin& origin, const State& state);

/// Reads and checks all of it: InputError "PATH does not exist", "is no checkpoint", "was written by a newer
/// throng", "is damaged: ...". Sizes are held against that of the file before memory is taken.
Checkpoint read_checkpoint(const std::string& path);

/// Removes both checkpoints of a recording, and what an attempt to write one left.
void remove_checkpoints(const std::string& recording);

}  // namespace recording
}  // namespace throng
