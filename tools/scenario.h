// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scenarios/load.h"

namespace throng::tools {

/// Prints what is wrong with the file `name` to stderr, and throws InputError where some of it are errors.
void expect_sound(std::span<const Diagnostic> diagnostics, const std::string& name);

/// Reads a scenario, prints its warnings and errors to stderr, and throws InputError where there are errors.
/// A scene without a name takes the file's.
Loaded load_or_throw(const std::string& file, const std::vector<std::string>& overrides = {});

/// The same for a scenario's text, which keeps the name that it has; `name` stands for it in messages.
Loaded load_text_or_throw(const std::string& text, const std::string& name,
                          const std::vector<std::string>& overrides = {});

}  // namespace throng::tools
