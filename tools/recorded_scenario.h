// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/recording/recording.h"

namespace throng::tools {

/// Throws InputError, naming the first difference, where the recording in `file` is not one of this scene: of
/// other bodies or other steps, or where it holds other things than the scene wants recorded. Where its
/// frames end is not looked at.
void expect_scenario(const Recording& recording, const Scene& scene, const std::string& file);

}  // namespace throng::tools
