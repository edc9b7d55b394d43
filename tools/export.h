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

/// A line each who arrived, in the order of their steps, below a line of names: id, step, time.
void export_arrivals_csv(const Arrivals& arrivals, double dt, const ExportTarget& target);

/// A text dump as LAMMPS writes it, which OVITO and MDAnalysis read: id, type (the number of the shape, from
/// 1), x, y, z = 0, radius (where a body is no disc, of the circle around it), mass, and what was recorded of
/// vx, vy, of the orientation, as a unit quaternion about z and as an angle, and of omegaz. SI units; numbers
/// but the quaternion's read back as they were. The box is the domain; in the unbounded plane what encloses
/// the bodies of the frame. Expects recorded positions.
void export_lammps(const Recording& recording, std::span<const std::size_t> frames,
                   const ExportTarget& target);

/// XML through which ParaView reads the recording, that of `file`, where it lies: by its path from the folder
/// of the target's name, or from the root where that is a device or a pipe. Where bodies come and go, without
/// their radius, which stands in another order, and without frames that hold none. Expects recorded
/// positions. Throws InputError where ParaView would not open the recording.
void export_xdmf(const Recording& recording, const std::string& file, std::span<const std::size_t> frames,
                 const ExportTarget& target);

}  // namespace throng::tools
