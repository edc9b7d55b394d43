// SPDX-License-Identifier: MIT
#include <cstdio>

#include "sim/recording/recording.h"
#include "tools/commands.h"

namespace throng::tools {

void say_where_incomplete(const Recording& recording, const std::string& file) {
  if (recording.complete()) return;
  std::fprintf(stderr, "throng: %s is %s\n", file.c_str(),
               recording.running() ? "still being written: these are its frames so far"
                                   : "of a run that did not end: these are the frames it committed");
}

}  // namespace throng::tools
