// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace throng {

/// A field that two scenarios don't have alike.
struct ScenarioDifference {
  std::string field;       ///< its path, such as "bodies[0].count"
  std::string one, other;  ///< its value in each, as TOML has it and shortened; "given" of a table, "absent"
};

/// The first field in which two resolved scenarios differ, simple values before tables; the end of the run
/// doesn't count. Nothing where there is none. A text that is no TOML differs in "the text". O(n).
std::optional<ScenarioDifference> scenario_difference(const std::string& one, const std::string& other);

}  // namespace throng
