// SPDX-License-Identifier: MIT
#pragma once

#include "sim/recording/recording.h"

namespace throng::tools {

/// Runs the scenario in the recording again and compares every frame: the hash of the whole state, and the
/// recorded numbers bit for bit. Prints "verified: N frames" and returns 0, or the first divergence and
/// returns 1. Takes as long as the run did. Throws InputError where the file is damaged or its scenario can't
/// be run.
int verify(const Recording& recording, const std::string& file, int threads);

}  // namespace throng::tools
