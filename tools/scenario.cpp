// SPDX-License-Identifier: MIT
#include "tools/scenario.h"

#include <cstdio>
#include <filesystem>

#include "scenarios/report.h"
#include "sim/input_error.h"
#include "sim/recording/utf8.h"

namespace throng::tools {

void expect_sound(std::span<const Diagnostic> diagnostics, const std::string& name) {
  std::fputs(to_string(diagnostics, name).c_str(), stderr);
  if (const int n = errors(diagnostics); n > 0)
    throw InputError(name + ": " + (n >= scenarios::Report::kMostErrors ? "the first " : "") +
                     std::to_string(n) + (n == 1 ? " error" : " errors"));
}

Loaded load_or_throw(const std::string& file, const std::vector<std::string>& overrides) {
  Loaded loaded = load_scenario(file, overrides);
  expect_sound(loaded.diagnostics, file);
  if (loaded.scene.name.empty())
    loaded.scene.name = recording::as_utf8(std::filesystem::path(file).stem().string());
  return loaded;
}

Loaded load_text_or_throw(const std::string& text, const std::string& name,
                          const std::vector<std::string>& overrides) {
  Loaded loaded = load_scenario_text(text, name, overrides);
  expect_sound(loaded.diagnostics, name);
  return loaded;
}

}  // namespace throng::tools
