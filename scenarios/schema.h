// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scenarios/grammar.h"

namespace throng::scenarios {

/// Any grammar as a JSON Schema (draft 2020-12). `about`: who prints it.
std::string schema(const Table& grammar, const std::string& title, const std::string& about);

/// That of scenarios as a JSON Schema (draft 2020-12), for editors that complete and check scenario files:
/// what stands in scenarios/scenario.schema.json. What only a whole file can tell, such as names and
/// geometry, it leaves to `validate`.
std::string schema();

}  // namespace throng::scenarios
