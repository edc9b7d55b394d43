// SPDX-License-Identifier: MIT
#include "tools/scenario.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "scenarios/report.h"
#include "sim/crowd/walk.h"
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

/// An option that is short for a field.
void add_field(CLI::App& command, Overrides& overrides, const char* name, const char* field, bool text,
               const char* help) {
  command.add_option_function<std::string>(
      name,
      [&overrides, name, field, text](const std::string& value) {
        overrides.add(name, value, field, text ? "\"" + value + "\"" : value);
      },
      std::string(help) + "; sets " + field);
}

/// The path of "PATH=VALUE".
std::string path_of(std::string field) {
  field.resize(std::min(field.find('='), field.size()));
  std::erase(field, ' ');
  return field;
}

/// Refuses a field that is set by an option and otherwise by --set.
void expect_no_contradiction(const Overrides& overrides) {
  for (const auto& [set, typed] : overrides.options)
    for (const std::string& field : overrides.fields)
      if ("--set " + field != set && path_of("--set " + field) == path_of(set))
        throw InputError(typed + " and --set " + field + " contradict each other: give one of them");
}

/// In the words of who typed them.
void name_options(std::vector<Diagnostic>& diagnostics, const Overrides& overrides) {
  for (Diagnostic& one : diagnostics)
    if (const auto typed = overrides.options.find(one.source); typed != overrides.options.end())
      one.source = typed->second;
}

}  // namespace

void add_scenario_options(CLI::App& command, Overrides& overrides) {
  add_field(command, overrides, "--until", "time.until", false, "end of the run (s)");
  add_field(command, overrides, "--dt", "time.dt", false, "length of a step (s)");
  add_field(command, overrides, "--substeps", "time.substeps", false, "solver's substeps in a step");
  add_field(command, overrides, "--engine", "engine", true, "native, box2d or event_driven");
  add_field(command, overrides, "--seed", "seed", false, "of all randomness");
  add_field(command, overrides, "--every", "record.every", false,
            "record each Nth step from the first state on, the last one where N divides it");
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&overrides](const std::vector<std::string>& given) {
            std::ranges::copy(given, std::back_inserter(overrides.fields));
          },
          "PATH=VALUE: another value for any field, as in time.dt=0.005 or bodies.0.spin=2; may be repeated")
      ->allow_extra_args(false);
}

Loaded load_or_throw(const std::string& file, const Overrides& overrides) {
  expect_no_contradiction(overrides);
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

void expect_ways(const Loaded& loaded, const std::string& file) {
  if (loaded.scene.crowd.size() == 0) return;
  try {
    const Walk walk(loaded.scene);
  } catch (const NoWay& no_way) {
    refuse(no_way, loaded, file);
  }
}

void refuse(const NoWay& no_way, const Loaded& loaded, const std::string& file) {
  if (no_way.group >= loaded.goals.size()) throw no_way;
  Diagnostic fault = loaded.goals[no_way.group];
  fault.message = no_way.reason;
  expect_sound({&fault, 1}, file);
  throw no_way;
}

}  // namespace throng::tools
