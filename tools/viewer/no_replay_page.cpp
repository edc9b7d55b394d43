// SPDX-License-Identifier: MIT
#include "tools/replay_page.h"

namespace throng::tools {

/// Stands in for the page where there was no Node to make it.
const char* const kReplayHtml[] = {nullptr};

}  // namespace throng::tools
