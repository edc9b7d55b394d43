// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scenarios/toml.h"

namespace throng::scenarios {

/// The tree as TOML that parses back to the same tree, numbers bit for bit: simple values first, then
/// [tables] and [[lists of tables]], keys ascending. The same tree gives the same text everywhere. O(n).
std::string print(const toml::table& root);

/// A value alone, on one line.
std::string print(const toml::node& value);

}  // namespace throng::scenarios
