// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scenarios/grammar.h"

namespace throng::scenarios {

/// Any grammar as text for people, after the line `about`.
std::string reference(const Table& grammar, const std::string& about);

/// That of scenarios as text for people: a line a field with its path, what it means, what it may hold and
/// what it is when absent. In the order of the grammar.
std::string reference();

}  // namespace throng::scenarios
