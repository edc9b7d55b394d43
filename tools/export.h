// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sim/recording/export.h"

/// Recordings as texts that other programs read; those in HDF5 stand in sim/recording/export.h. All read a
/// frame at a time; `frames` are ascending, one or more. All throw InputError where `target` can't be
/// written, which then holds a part, and what Recording::read throws.
namespace throng::tools {

/// A line a frame and body below a line of names: step, time, id, and what was recorded of x, y, vx, vy,
/// angle, spin. Numbers read back as they were.
void export_csv(const Recording& recording, std::span<const std::size_t> frames, const ExportTarget& target);

/// XML through which ParaView reads the recording, that of `file`, where it lies: by its path from the folder
/// of the target's name, or from the root where that is a device or a pipe. Expects recorded positions.
/// Throws InputError where ParaView would not open the recording.
void export_xdmf(const Recording& recording, const std::string& file, std::span<const std::size_t> frames,
                 const ExportTarget& target);

}  // namespace throng::tools
