// SPDX-License-Identifier: MIT
#pragma once

#include "scenarios/grammar.h"
#include "scenarios/report.h"

namespace throng::scenarios {

/// Holds the tree against the grammar and reports each fault: unknown keys and names, wrong types, numbers
/// out of range, what is missing, what stands there twice in two forms, what is not supported yet. A node
/// with a fault in it is marked bad; whatever is not bad may be read without further questions. O(size of the
/// tree).
void check(const toml::table& root, const Table& grammar, Report& report);

}  // namespace throng::scenarios
