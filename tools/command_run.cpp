// SPDX-License-Identifier: MIT
// throng run: a scenario in, a summary out, and a recording where one is asked for.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "sim/input_error.h"
#include "sim/recording/recorder.h"
#include "sim/simulation.h"
#include "tools/commands.h"
#include "tools/drive.h"
#include "tools/scenario.h"
#include "tools/summary.h"

namespace throng::tools {

namespace {

struct RunOptions {
  std::string scene, output, command_line;
  Overrides overrides;
  DriveOptions drive;
  bool force = false, dry_run = false;
};

/// One word for a shell, whatever the text holds.
std::string quoted(const std::string& text) {
  const bool plain = text.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                         "_-./=,:+@%") == std::string::npos;
  if (plain && !text.empty()) return text;
  std::string word = "'";
  for (char c : text) c == '\'' ? word += "'\\''" : word += c;
  return word + "'";
}

/// What to type to see the same failure again.
std::string reproduction(const RunOptions& options) {
  std::string text = "throng run " + quoted(options.scene);
  for (const std::string& o : options.overrides.fields) text += " --set " + quoted(o);
  return text + " --threads " + std::to_string(options.drive.threads);
}

/// A recording under the name of something else would be taken for that.
void expect_name_of_recording(const std::string& output) {
  constexpr std::array<std::string_view, 13> kOthers{".csv",    ".txt",  ".json", ".toml", ".xdmf",
                                                     ".lammps", ".html", ".htm",  ".png",  ".mp4",
                                                     ".mov",    ".mkv",  ".webm"};
  const std::string ending = std::filesystem::path(output).extension();
  if (std::ranges::find(kOthers, ending) != kOthers.end())
    throw InputError(
        "cannot write " + output +
        ": a recording is HDF5, as OUT.h5; `throng export` and `throng replay` make other files of it");
}

std::unique_ptr<Simulation> simulation_of(const Loaded& loaded, const RunOptions& options) {
  try {
    return throng::simulation(loaded.scene, options.drive.threads);
  } catch (const NoWay& no_way) {
    refuse(no_way, loaded, options.scene);
  }
}

/// All that a run does but run. Returns the exit code.
int rehearse(const RunOptions& options, const Loaded& loaded, const Provenance& provenance) {
  const auto simulation = simulation_of(loaded, options);
  if (!options.output.empty()) {
    Recorder::expect_writable(options.output, loaded.scene, provenance, options.force);
    warn_of_room(options.output, loaded.scene, provenance);
    warn_of_last_state(loaded.scene);
  }
  print(summary(loaded.scene, *simulation, RunTimes(), ""));
  return 0;
}

int run(const RunOptions& options) {
  if (options.drive.checkpoint && options.output.empty())
    throw InputError("--checkpoint stands beside a recording: give -o too");
  const Loaded loaded = load_or_throw(options.scene, options.overrides);
  const Scene& scene = loaded.scene;
  say_promise(scene);
  std::error_code neither;
  if (std::filesystem::equivalent(options.output, options.scene, neither))
    throw InputError("cannot write " + options.output + ": it is the scenario");
  expect_name_of_recording(options.output);
  const Provenance provenance{loaded.text, loaded.resolved, options.command_line, options.drive.threads,
                              options.drive.checkpoint.value_or(0.0)};
  if (options.dry_run) return rehearse(options, loaded, provenance);

  const auto simulation = simulation_of(loaded, options);
  stop_on_signals();
  warn_of_checkpoints(options.drive, scene);
  warn_of_threads(options.drive, scene);
  std::optional<Recorder> recorder;
  if (!options.output.empty()) {
    recorder.emplace(options.output, scene, provenance, options.force);
    warn_of_room(options.output, scene, provenance);
    warn_of_last_state(scene);
  }
  try {
    return drive(*simulation, scene, options.drive, recorder ? &*recorder : nullptr);
  } catch (const SimulationError& error) {
    throw SimulationError(std::string(error.what()) + "; to reproduce: " + reproduction(options));
  }
}

}  // namespace

void add_run(CLI::App& app, int& exit_code, const std::string& command_line) {
  auto options = std::make_shared<RunOptions>();
  options->command_line = command_line;
  CLI::App* command = app.add_subcommand("run", "Runs a scenario; prints a summary as JSON, records with -o");
  command->add_option("SCENE", options->scene, "scenario file")->required();
  command
      ->add_option("-o,--output", options->output,
                   "recording to write (HDF5); without it nothing is recorded")
      ->check([](const std::string& name) { return name.empty() ? "needs a name" : std::string(); });
  add_scenario_options(*command, options->overrides);
  add_drive_options(*command, options->drive);
  command->add_flag("--dry-run", options->dry_run,
                    "reads and checks everything, summarises the first state, runs nothing");
  command->add_flag("--force", options->force, "overwrites the recording where it exists");
  command->footer(
      "Example: throng run scenarios/pile.toml -o pile.h5 --until 5 --threads 2\n"
      "A stopped or failed run leaves its frames in OUT.h5.part, which every command reads and resume goes "
      "on "
      "with.\n"
      "step_ms and stages of the summary are means, ms a step.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace throng::tools
