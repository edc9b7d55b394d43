// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sim/recording/recording.h"

/// Recordings as HDF5 files that other programs of the field open. Both make the file at `target`, or empty
/// the one that is there, and read a frame at a time; `frames` are ascending, one or more. Both throw
/// InputError where `target` can't be written, which then holds a part, and what Recording::read throws.
/// Expect recorded positions.
namespace throng {

struct ExportTarget {
  std::string path;  ///< of the file to write
  std::string name;  ///< the path that it will have: what messages call it, and where it points from
};

/// The table of the Pedestrian Dynamics Data Archive (Jülich), as PedPy's
/// load_trajectory_from_ped_data_archive_hdf5 reads it: a row (id, frame, x, y) for each frame, counted from
/// 0, and each agent, or, where the recording has none, each body that isn't static. The walkable area is
/// that of the agents, else the domain, grown where the centre of one of them has left it; in the unbounded
/// plane the rectangle around the walls and all that they reached. Throws InputError where all bodies are
/// static or the frames are not evenly spaced in time.
void export_pedpy(const Recording& recording, std::span<const std::size_t> frames,
                  const ExportTarget& target);

/// Whether all of these frames have velocities.
bool have_velocities(const Recording& recording, std::span<const std::size_t> frames);

/// H5MD 1.1 in three dimensions with z = 0, which MDAnalysis needs: positions and, where all the
/// frames have them, velocities; mass, radius and id of the bodies. Plain numbers in SI units: no `unit`
/// attributes, for MDAnalysis knows no metre. A periodic domain has edges, 1 m in z. Where bodies come and
/// go, each keeps its row; while it is away, its place and velocity are NaN, and its id, of each frame then,
/// is 0, the fill value.
void export_h5md3(const Recording& recording, std::span<const std::size_t> frames,
                  const ExportTarget& target);

}  // namespace throng
