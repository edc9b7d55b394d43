// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/recording/recording.h"

namespace throng::tools {

/// The page of tools/viewer in pieces, nullptr after the last; @GIVEN@ and @RECORDING@ stand where the data
/// go. Without pieces where throng was built without Node.
extern const char* const kReplayHtml[];

/// Bytes of the largest recording that becomes part of its page, which is a third larger: browsers open such
/// pages in a second.
inline constexpr double kLargestEmbedded = 64e6;

/// Writes one HTML file that replays recordings in a browser, without network. It holds the recording, that
/// of `file`, byte for byte; one that is larger than kLargestEmbedded or still being written is named, and
/// the page asks for it and reads it in place. What it holds is checked, each frame against its hash.
/// O(bytes). Throws InputError where the program has no page, positions were not recorded, there is no frame,
/// one is damaged, or `output` can't be written; no half file stays. Returns whether the page holds the
/// recording.
bool write_replay_page(const Recording& recording, const std::string& file, const std::string& output);

}  // namespace throng::tools
