// SPDX-License-Identifier: MIT
#pragma once

#include "sim/recording/recording.h"

namespace throng::tools {

/// Plays a recording in the terminal, `speed` times as fast as it happened, dropping frames that it has no
/// time for, and leaves its last picture behind. Space pauses, arrows seek a twentieth of it, or one frame
/// where it is paused, + and - double and halve the speed, q ends it. Returns 0, or 130 where SIGINT or
/// SIGTERM ended it. Expects frames and recorded positions. Throws InputError where the standard output is no
/// terminal or a frame is damaged.
int play(const Recording& recording, double speed);

}  // namespace throng::tools
