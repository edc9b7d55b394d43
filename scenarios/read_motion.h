// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenarios/load.h"
#include "scenarios/motion_task.h"

namespace throng {

/// A motion file as read: usable where it has no errors.
struct LoadedMotion {
  MotionTask task;
  std::vector<Diagnostic> diagnostics;  ///< in the order of the text; at most 20 errors
  int errors() const { return throng::errors(diagnostics); }
};

/// What "-" is called.
inline constexpr const char* kStandardInput = "standard input";

/// Reads a motion file; "-" is the standard input. Never throws for a bad one: it says so in the diagnostics.
LoadedMotion load_motion(const std::string& file);

/// The same for a text; `name` stands for the file in messages, and beside it lie its surroundings.
LoadedMotion load_motion_text(const std::string& text, const std::string& name);

}  // namespace throng
