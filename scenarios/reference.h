// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace throng::scenarios {

/// The grammar as text for people: a line a field with its path, what it means, what it may hold and what it
/// is when absent. In the order of the grammar.
std::string reference();

}  // namespace throng::scenarios
