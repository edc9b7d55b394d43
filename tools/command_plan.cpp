// SPDX-License-Identifier: MIT
// throng plan: the stages that a scene runs and those that it skips, each with its reason.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "sim/auto_time.h"
#include "sim/crowd/walk.h"
#include "sim/crowd/ways_size.h"
#include "sim/plan.h"
#include "sim/recording/expected_bytes.h"
#include "sim/uses_substeps.h"
#include "tools/commands.h"
#include "tools/printable.h"
#include "tools/scenario.h"

namespace throng::tools {

namespace {

using Json = nlohmann::ordered_json;

/// Frames that a whole run records.
std::int64_t frames(const Scene& scene) {
  return count_frames(scene.record, scene.time.steps());
}

std::size_t count(const Scene& scene, BodyKind kind) {
  std::size_t n = 0;
  for (BodyKind k : scene.bodies.kind) n += k == kind;
  return n;
}

/// Of a crowd.
WaysSize ways(const Scene& scene) {
  const Barriers barriers(barrier_lines(scene), 1.0);
  return ways_size(scene, barriers, sizes_by_goal(scene, barriers));
}

Json ways_json(const Scene& scene) {
  if (scene.crowd.size() == 0) return nullptr;
  const WaysSize size = ways(scene);
  return {{"fields", size.fields}, {"plans", size.plans}, {"bytes", std::llround(size.bytes)}};
}

Json to_json(const Scene& scene, const Plan& plan) {
  Json stages = Json::array();
  for (const Stage& stage : plan.stages)
    stages.push_back({{"stage", stage.name}, {"runs", stage.runs}, {"reason", stage.reason}});
  Json chosen = nullptr;
  if (scene.time.error > 0.0) {
    const AutoTime time = auto_time(scene);
    chosen = {{"error", scene.time.error}, {"promise", time.promise}, {"why", time.why}};
  }
  return {{"scenario", scene.name},
          {"engine", engine_name(scene.engine)},
          {"bodies", scene.bodies.size() - scene.crowd.size()},
          {"agents", scene.crowd.size()},
          {"dynamic", count(scene, BodyKind::dynamic)},
          {"static", count(scene, BodyKind::fixed)},
          {"kinematic", count(scene, BodyKind::kinematic)},
          {"walls", scene.walls.size()},
          {"steps", scene.time.steps()},
          {"dt", scene.time.dt},
          {"substeps", uses_substeps(scene) ? Json(scene.time.substeps) : Json(nullptr)},
          {"auto", chosen},
          {"stages", stages},
          {"ways", ways_json(scene)},
          {"frames", frames(scene)},
          {"output_bytes", std::llround(std::min(recording::expected_bytes(scene), 9e18))}};
}

std::string size_text(double bytes) {
  const char* units[] = {"B", "kB", "MB", "GB", "TB"};
  int unit = 0;
  while (bytes >= 1000.0 && unit < 4) bytes /= 1000.0, ++unit;
  char text[32];
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.1f %s", bytes, units[unit]);
  return text;
}

/// What nobody knows before the run.
std::string how_sure(const Scene& scene) {
  std::string text;
  const auto add = [&](bool is_so, const char* guess) {
    if (is_so) text += (text.empty() ? " if " : ", ") + std::string(guess);
  };
  add(bodies_come_and_go(scene), "all are there from the first to the last");
  add(every(scene.record, RecordField::contacts) > 0, "each has three contacts");
  add(!scene.record.sensors.empty(), "sensors find others spread evenly");
  add(scene.record.quantum > 0.0, "positions pack into three bytes a body");
  return text;
}

/// " in 4 substeps of h = 0.0025 s", "" where there are none.
std::string substeps_text(const Scene& scene) {
  if (!uses_substeps(scene)) return "";
  char length[40];
  std::snprintf(length, sizeof length, " of h = %.3g s", scene.time.dt / scene.time.substeps);
  return " in " + counted(scene.time.substeps, "substep") + length;
}

void print_ways(const Scene& scene) {
  const WaysSize size = ways(scene);
  std::printf(
      "\nways: %s on %s, %s%s\n", counted(static_cast<std::int64_t>(size.fields), "distance field").c_str(),
      counted(static_cast<std::int64_t>(size.plans), "floor plan").c_str(), size_text(size.bytes).c_str(),
      size.bytes > kMostWaysBytes ? ": too much, a run is refused" : "");
}

void print_plan(const Scene& scene, const Plan& plan) {
  std::printf(
      "%s: %s (%zu dynamic, %zu static, %zu kinematic), %s, %s; engine %s\n", printable(scene.name).c_str(),
      counted_bodies(scene.bodies.size() - scene.crowd.size()).c_str(), count(scene, BodyKind::dynamic),
      count(scene, BodyKind::fixed), count(scene, BodyKind::kinematic),
      counted(static_cast<std::int64_t>(scene.crowd.size()), "agent").c_str(),
      counted(static_cast<std::int64_t>(scene.walls.size()), "wall").c_str(), engine_name(scene.engine));
  std::printf("%s of %g s%s\n", counted(scene.time.steps(), "step").c_str(), scene.time.dt,
              substeps_text(scene).c_str());
  if (scene.time.error > 0.0) {
    const AutoTime chosen = auto_time(scene);
    std::printf("chosen for an error of %g: %s; %s\n", scene.time.error, chosen.promise.c_str(),
                chosen.why.c_str());
  }
  std::puts("");
  if (scene.engine == Engine::box2d)
    std::puts("Box2D runs the whole step in one stage; the native engine would run:");
  if (scene.engine == Engine::event_driven)
    std::puts("From collision to collision in one stage, without a time step; the native engine would run:");
  for (const Stage& stage : plan.stages)
    std::printf("  %-7s %-14s %s\n", stage.runs ? "runs" : "skipped", stage.name.c_str(),
                stage.reason.c_str());
  if (scene.crowd.size() > 0) print_ways(scene);
  std::printf("\nrecorded in full: %s, about %s%s\n", counted(frames(scene), "frame").c_str(),
              size_text(recording::expected_bytes(scene)).c_str(), how_sure(scene).c_str());
}

struct PlanOptions {
  std::string scene;
  Overrides set;
  bool json = false;
};

}  // namespace

void add_plan(CLI::App& app, int&) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command =
      app.add_subcommand("plan", "Shows which stages a scene runs or skips, why, and what it will write");
  command->add_option("SCENE", options->scene, "scenario file")->required();
  add_scenario_options(*command, options->set);
  command->add_flag("--json", options->json, "one JSON object instead of text");
  command->footer("Example: throng plan scenarios/pile.toml");
  command->callback([options] {
    const Loaded loaded = load_or_throw(options->scene, options->set);
    const Plan plan = plan_for(loaded.scene);
    if (options->json)
      std::puts(to_json(loaded.scene, plan).dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    else
      print_plan(loaded.scene, plan);
  });
}

}  // namespace throng::tools
