// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/recording/recording.h"

namespace throng::tools {

struct FilmOptions {
  double speed = 1.0;  ///< times as fast as it happened
  int rate = 25;       ///< pictures a second
  int width = 1600;    ///< pixels, at most, and of the height as well
};

/// Draws a recording as a film, from its first frame to its last, by ffmpeg. Each picture is of the frame
/// nearest in time. Expects frames and recorded positions. Throws InputError where there is no ffmpeg,
/// `output` isn't called like a film or can't be written, or a frame is damaged; no half file stays.
void write_film(const Recording& recording, const std::string& output, const FilmOptions& options);

}  // namespace throng::tools
