// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scenarios/load.h"
#include "sim/crowd/ways.h"

namespace CLI {
class App;
}

namespace throng::tools {

/// Prints what is wrong with the file `name` to stderr, and throws InputError where some of it are errors.
void expect_sound(std::span<const Diagnostic> diagnostics, const std::string& name);

/// Fields of a scenario that the command line sets.
struct Overrides {
  std::vector<std::string> fields = {};             ///< "PATH=VALUE"
  std::map<std::string, std::string> options = {};  ///< what was typed for a field where that wasn't --set

  /// Adds what was typed as `option`, which is short for a field.
  void add(const std::string& option, const std::string& given, const std::string& field,
           const std::string& value);
};

/// Declares --until, --dt and the others that are short for a field, and --set for any. `overrides` is to
/// live as long as `command`.
void add_scenario_options(CLI::App& command, Overrides& overrides);

/// Reads a scenario, prints its warnings and errors to stderr, and throws InputError where there are errors.
/// A scene without a name takes the file's.
Loaded load_or_throw(const std::string& file, const Overrides& overrides = {});

/// The same for a scenario's text, which keeps the name that it has; `name` stands for it in messages.
Loaded load_text_or_throw(const std::string& text, const std::string& name, const Overrides& overrides = {});

/// Refuses a scenario in which no way leads an agent to its goal, as load_or_throw refuses others. O(nodes of
/// all goals' floors).
void expect_ways(const Loaded& loaded, const std::string& file);

/// Prints that at its place in the file, and throws as expect_sound does.
[[noreturn]] void refuse(const NoWay& no_way, const Loaded& loaded, const std::string& file);

}  // namespace throng::tools
