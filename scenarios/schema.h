// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace throng::scenarios {

/// The grammar as a JSON Schema (draft 2020-12), for editors that complete and check scenario files: what
/// stands in scenarios/scenario.schema.json. What only a whole file can tell, such as names and geometry, it
/// leaves to `validate`.
std::string schema();

}  // namespace throng::scenarios
