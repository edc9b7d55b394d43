// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sim/recording/recording.h"

namespace throng::tools {

/// Fields to be set for a recording's scenario to be that of its run: the substeps where it doesn't say how
/// many, as earlier versions chose fewer.
std::vector<std::string> fields_of_run(const Recording& recording);

/// Throws InputError, naming the first difference, where the recording in `file` is not one of this scene: of
/// other bodies or other steps, or where it holds other things than the scene wants recorded. Where its
/// frames end is not looked at.
void expect_scenario(const Recording& recording, const Scene& scene, const std::string& file);

}  // namespace throng::tools
