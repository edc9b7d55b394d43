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

void Overrides::add(const std::string& option, const std::string& given, const std::string& field,
                    const std::string& value) {
  fields.push_back(field + "=" + value);
  options["--set " + fields.back()] = option + " " + given;
}

namespace {

/// In the words of who typed them.
void name_options(std::vector<Diagnostic>& diagnostics, const Overrides& overrides) {
  for (Diagnostic& one : diagnostics)
    if (const auto typed = overrides.options.find(one.source); typed != overrides.options.end())
      one.source = typed->second;
}

}  // namespace

Loaded load_or_throw(const std::string& file, const Overrides& overrides) {
  Loaded loaded = load_scenario(file, overrides.fields);
  name_options(loaded.diagnostics, overrides);
  expect_sound(loaded.diagnostics, file);
  if (loaded.scene.name.empty())
    loaded.scene.name = recording::as_utf8(std::filesystem::path(file).stem().string());
  return loaded;
}

Loaded load_text_or_throw(const std::string& text, const std::string& name, const Overrides& overrides) {
  Loaded loaded = load_scenario_text(text, name, overrides.fields);
  name_options(loaded.diagnostics, overrides);
  expect_sound(loaded.diagnostics, name);
  return loaded;
}

}  // namespace throng::tools
