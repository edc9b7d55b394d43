// SPDX-License-Identifier: MIT
#pragma once

#include <hdf5.h>

#include "sim/scene.h"

namespace throng::recording {

/// Writes what of the scene never changes below the group `throng` (layout.h): domain, materials, shapes,
/// bodies, walls. Throws h5::Error.
void write_scene(hid_t throng, const Scene& scene);

}  // namespace throng::recording
