// SPDX-License-Identifier: MIT
#pragma once

#include <hdf5.h>

#include <span>

#include "sim/scene.h"

namespace throng::recording {

/// Writes what of the scene never changes below the group `throng` (layout.h): domain, materials, shapes,
/// walls, and the bodies of these `ids`. Throws h5::Error.
void write_scene(hid_t throng, const Scene& scene, std::span<const std::uint32_t> ids);

}  // namespace throng::recording
