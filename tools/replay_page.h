// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/recording/recording.h"

namespace throng::tools {

/// tools/viewer/replay.html in pieces, nullptr after the last; @SCENE@ and @FRAMES@ stand where the data go.
extern const char* const kReplayHtml[];

/// Writes one HTML file that replays the recording in a browser, without network: geometry and frames are
/// embedded, places to 1 part in 20,000 of the picture, the frames thinned so that the file stays below about
/// 20 MB (the page says so). Reads each frame once or twice. Throws InputError where positions were not
/// recorded, there is no frame, or `output` can't be written; no half file stays.
void write_replay_page(const Recording& recording, const std::string& output);

}  // namespace throng::tools
