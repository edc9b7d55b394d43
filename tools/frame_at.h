// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "sim/recording/recording.h"

namespace throng::tools {

/// The frame that is nearest to time `at` (s), up to rounding within the recording; without it the last one.
/// Expects frames. Throws InputError that names `file` where `at` is outside.
std::size_t frame_at_or_throw(const Recording& recording, const std::string& file, std::optional<double> at);

}  // namespace throng::tools
