// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "scenarios/load.h"
#include "scenarios/reference.h"
#include "scenarios/schema.h"
#include "sim/input_error.h"
#include "tools/commands.h"
#include "tools/printable.h"
#include "tools/scenario.h"

namespace throng::tools {

namespace {

struct ValidateOptions {
  std::string file;
  Overrides overrides;
  bool schema = false, fields = false;
};

int validate(const ValidateOptions& options) {
  if (options.schema) {
    std::fputs(scenarios::schema().c_str(), stdout);
    return 0;
  }
  if (options.fields) {
    std::fputs(scenarios::reference().c_str(), stdout);
    return 0;
  }
  if (options.file.empty()) throw InputError("validate needs a scenario file; see throng validate --help");
  const Loaded loaded = load_or_throw(options.file, options.overrides);
  expect_ways(loaded, options.file);
  const Scene& scene = loaded.scene;
  const auto size = [](const auto& list) { return static_cast<std::int64_t>(list.size()); };
  const std::size_t agents = scene.crowd.size();
  std::printf("%s: ok, %s, %s, %s, %s, %s, %s\n", options.file.c_str(),
              counted_bodies(scene.bodies.size() - agents).c_str(),
              counted(static_cast<std::int64_t>(agents), "agent").c_str(),
              counted(size(scene.shapes), "shape").c_str(),
              counted(size(scene.materials), "material").c_str(), counted(size(scene.walls), "wall").c_str(),
              counted(scene.time.steps(), "step").c_str());
  return 0;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("validate", "Reads a scenario and reports every fault in it");
  command->footer("Example: throng validate scenarios/pile.toml --set time.dt=0.005");
  const auto options = std::make_shared<ValidateOptions>();
  command->add_option("SCENE", options->file, "The scenario file");
  command
      ->add_option("--set", options->overrides.fields,
                   "PATH=VALUE: another value for a field; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--schema", options->schema,
                    "Print the JSON Schema of scenario files, for editors, and nothing else");
  command->add_flag("--fields", options->fields,
                    "Print all fields of scenario files, what they mean and what they are when absent");
  command->callback([options, &exit_code] { exit_code = validate(*options); });
}

}  // namespace throng::tools
