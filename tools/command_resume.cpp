// SPDX-License-Identifier: MIT
// throng resume: goes on with a recording whose run was stopped or killed, or is to last longer.
#include <CLI/CLI.hpp>
#include <cinttypes>
#include <cstdio>
#include <memory>

#include "sim/input_error.h"
#include "sim/plan.h"
#include "tools/commands.h"
#include "tools/drive.h"
#include "tools/recorded_scenario.h"
#include "tools/resume_point.h"
#include "tools/scenario.h"

namespace throng::tools {

namespace {

struct ResumeOptions {
  std::string file, until, command_line;
  DriveOptions drive;
};

/// Samples that are there lack what later ones would have.
void refuse_older_samples(const Kept& kept, const Scene& scene) {
  if (kept.frames == 0) return;
  const auto refuse = [&](const char* lacks) {
    throw InputError(kept.source + " cannot be gone on with: " + lacks);
  };
  const int minor = kept.recording.origin().minor;
  if (minor < 11 && plan_for(scene).sums_impulses)
    refuse("contacts told less of what presses before layout 1.11");
  if (scene.crowd.size() == 0 || scene.record.observables == 0) return;
  if (minor < 5) refuse("observables of a crowd were not recorded before layout 1.5");
  for (const Measure& measure : scene.crowd.measures)
    if (minor < 9 && measure.cutoff > 0.0) refuse("density_voronoi was not recorded before layout 1.9");
}

/// The scenario that the recording holds, with its end where it is wanted now.
Loaded load_recorded(const Kept& kept, const std::string& until) {
  Overrides overrides;
  if (!until.empty()) overrides.add("--until", until, "time.until", until);
  Loaded loaded =
      load_text_or_throw(kept.recording.origin().provenance.resolved, kept.source + ":scenario", overrides);
  if (loaded.scene.name.empty()) loaded.scene.name = kept.recording.geometry().name;
  expect_scenario(kept.recording, loaded.scene, kept.source);
  refuse_older_samples(kept, loaded.scene);
  return loaded;
}

/// Frames and checkpoint lie within the run, which may have been made shorter.
void expect_end_after(const Kept& kept, const std::optional<Checkpoint>& checkpoint, const Time& time) {
  const std::int64_t recorded = kept.frames > 0 ? kept.recording.steps()[kept.frames - 1] : 0;
  const std::int64_t reached = std::max(recorded, checkpoint ? checkpoint->state.step : 0);
  if (reached <= time.steps()) return;
  char text[120];
  std::snprintf(text, sizeof text, " has been run to %g s: it can't end before that, at %g s",
                static_cast<double>(reached) * time.dt, time.until);
  throw InputError(kept.source + text);
}

void say(const char* what, std::int64_t step) {
  std::fprintf(stderr, "throng: %s step %" PRId64 "\n", what, step);
}

/// Brings the simulation of the scene to the checkpoint. Returns false where a signal came first.
bool go_to(const Checkpoint& checkpoint, const Scene& scene, Simulation& simulation) {
  const State& goal = checkpoint.state;
  if (!fits(goal, scene))
    throw InputError(
        "the checkpoint's crowd or sensors are not those of the scenario: remove it to go on from the start");
  if (simulation.restore(goal)) {
    say("going on from the checkpoint at", goal.step);
    return true;
  }
  say("this engine's state can't be saved: computing again, and checking, up to the checkpoint at",
      goal.step);
  simulation.heed(stop_requested);
  try {
    while (simulation.state().step < goal.step && !stop_requested()) simulation.step();
  } catch (const Interrupted&) {  // by a signal, within a step
  }
  if (simulation.state().step < goal.step) return false;
  if (hash(simulation.state()) != hash(goal))
    throw SimulationError("step " + std::to_string(goal.step) +
                          " gives another state than the checkpoint has: this throng computes otherwise than "
                          "the one that wrote it; nothing was added");
  return true;
}

RecordedFrames recorded_frames(const Kept& kept) {
  const auto steps = kept.recording.steps().first(kept.frames);
  const auto hashes = kept.recording.state_hashes().first(kept.frames);
  return {{steps.begin(), steps.end()}, {hashes.begin(), hashes.end()}};
}

/// Checkpoints go on as the run made them, unless the command line says how often; where there is one, the
/// end has one, too, so that who makes the run longer goes on from there.
DriveOptions drive_options(const Kept& kept, const ResumeOptions& options, bool from_checkpoint) {
  DriveOptions drive = options.drive;
  drive.checkpoint_at_end = from_checkpoint;
  const double before = kept.recording.origin().provenance.checkpoint;
  if (!drive.checkpoint && before > 0.0) drive.checkpoint = before;
  return drive;
}

/// Both commands, as one that a shell understands.
Provenance provenance(const Kept& kept, const Loaded& loaded, const std::string& command_line,
                      const DriveOptions& drive) {
  const Provenance& first = kept.recording.origin().provenance;
  return {first.scenario, loaded.resolved, first.command_line + " && " + command_line, drive.threads,
          drive.checkpoint.value_or(0.0)};
}

int resume(const ResumeOptions& options) {
  const Kept kept = find_recording(options.file);
  const Loaded loaded = load_recorded(kept, options.until);
  const Scene& scene = loaded.scene;
  const std::optional<Checkpoint> checkpoint = find_checkpoint(kept);
  expect_end_after(kept, checkpoint, scene.time);
  const bool whole =
      kept.source == kept.output && kept.recording.complete() && kept.frames == kept.recording.frames();
  if (whole && kept.recording.geometry().time.until == scene.time.until) {
    std::fprintf(stderr, "throng: %s is complete up to %g s; --until T goes on from there\n",
                 kept.source.c_str(), scene.time.until);
    return 0;
  }
  const auto simulation = throng::simulation(scene, options.drive.threads);
  stop_on_signals();
  warn_of_checkpoints(options.drive, scene);
  warn_of_threads(options.drive, scene);
  if (!checkpoint)
    std::fprintf(stderr, "throng: no checkpoint: computing again, and checking, from the start\n");
  else if (!go_to(*checkpoint, scene, *simulation))
    return 130;
  const DriveOptions drive_now = drive_options(kept, options, checkpoint.has_value());
  const Provenance now = provenance(kept, loaded, options.command_line, drive_now);
  Recorder recorder(kept.output, scene, now, kept.recording, kept.frames);
  warn_of_room(kept.output, scene, now);
  warn_of_last_state(scene);
  return drive(*simulation, scene, drive_now, &recorder, recorded_frames(kept));
}

}  // namespace

void add_resume(CLI::App& app, int& exit_code, const std::string& command_line) {
  auto options = std::make_shared<ResumeOptions>();
  options->command_line = command_line;
  CLI::App* command = app.add_subcommand(
      "resume", "Goes on with a recording to the end that an uninterrupted run has, bit for bit");
  command->add_option("FILE", options->file, "recording: OUT.h5, or OUT.h5.part of a stopped or killed run")
      ->required();
  command->add_option("--until", options->until,
                      "another end of the run (s), no earlier than what is recorded");
  add_drive_options(*command, options->drive);
  command->footer(
      "Example: throng resume pile.h5 --until 20\n"
      "Goes on from OUT.h5.ckpt, or from the checkpoint before where that is damaged, or from the start\n"
      "where there is none (as box2d and event_driven always must): steps whose frames are recorded are\n"
      "then checked against them.\n"
      "Checkpoints are made as often as the run made them, or each --checkpoint SECONDS; where one was\n"
      "there, there is one of the end, too.\n"
      "The frames so far are copied first, so there must be room for them once more.");
  command->callback([options, &exit_code] { exit_code = resume(*options); });
}

}  // namespace throng::tools
