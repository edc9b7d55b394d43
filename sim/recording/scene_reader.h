// SPDX-License-Identifier: MIT
#pragma once

#include "sim/recording/h5_read.h"
#include "sim/scene.h"

namespace throng::recording {

/// What write_scene wrote below the group `throng`, every index and number checked. Positions and motion of
/// the bodies are zeros. Throws h5::Error.
Scene read_scene(const h5::File& file, hid_t throng);

/// The recorded sensors. Throws h5::Error.
std::vector<Sensor> read_sensors(hid_t throng);

}  // namespace throng::recording
