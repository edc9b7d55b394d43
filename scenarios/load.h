// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scene.h"

/// From a scenario file to a Scene.
namespace throng {

/// One thing wrong, or odd, in a scenario.
struct Diagnostic {
  enum class Severity { warning, error } severity = Severity::error;
  int line = 0, column = 0;  ///< from 1; 0 where it belongs to no place in the text
  std::string path;          ///< of the field, such as "shapes.ball.disc.radius"
  std::string message;       ///< what, and what is allowed
  std::string source = {};   ///< the override that it came from, such as "--set time.dt=0"; empty: the file
};

/// How many of them are errors.
int errors(std::span<const Diagnostic> diagnostics);

/// A scenario as read: usable where `errors()` is 0.
struct Loaded {
  Scene scene;
  std::vector<Diagnostic> diagnostics;  ///< in the order of the text; at most 20 errors
  std::vector<Diagnostic> goals;  ///< of each group of agents in the text: the place for a fault of its goal
  std::string text;               ///< as given
  std::string resolved;           ///< TOML with all overrides applied; loads to the same scene
  int errors() const { return throng::errors(diagnostics); }
};

/// Reads a scenario file. `overrides` are "PATH=VALUE" in the file's own paths and TOML's values.
/// Never throws for a bad file: it says so in the diagnostics.
Loaded load_scenario(const std::string& file, std::span<const std::string> overrides = {});

/// The same for a text; `name` stands for the file in messages and `folder` is where relative paths start.
Loaded load_scenario_text(std::string_view text, const std::string& name,
                          std::span<const std::string> overrides = {});

/// Whether the scenario says how many substeps there are in a step. O(n).
bool says_substeps(const std::string& text);

/// "FILE:LINE:COLUMN: error: PATH: MESSAGE", a line each.
std::string to_string(std::span<const Diagnostic> diagnostics, const std::string& file);

}  // namespace throng
