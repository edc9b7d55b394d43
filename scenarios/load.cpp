// SPDX-License-Identifier: MIT
#include "scenarios/load.h"

#include <algorithm>
#include <sstream>

#include "scenarios/check.h"
#include "scenarios/check_use.h"
#include "scenarios/override.h"
#include "scenarios/place.h"
#include "scenarios/print.h"
#include "scenarios/read_crowd.h"
#include "scenarios/source.h"
#include "sim/contact/candidates.h"
#include "sim/engine_box2d.h"
#include "sim/engine_event_driven.h"
#include "sim/uses_substeps.h"

namespace throng {

using namespace scenarios;

namespace {

/// Where bodies pass through all, nothing keeps them in.
void warn_of_idle_borders(const toml::table& root, const Scene& scene, Report& report) {
  if (scene.contact != ContactModel::none || !scene.crowd.groups.empty()) return;
  if (scene.domain.kind == DomainKind::box)
    report.warning(root["domain"]["box"].node()->source(), "domain.box",
                   "holds nobody: contact.model is \"none\", and the box is only drawn");
  if (root["walls"][0].node() && !root.contains("sensors"))  // which may heed them
    report.warning(root["walls"][0].node()->source(), "walls",
                   "hold nobody: contact.model is \"none\", and they are only drawn");
}

void warn_of_idle_surfaces(const toml::table& root, const Scene& scene, Report& report) {
  const toml::table* materials = root["materials"].as_table();
  if (!materials || scene.contact != ContactModel::none) return;
  for (const auto& [name, material] : *materials)
    for (const char* key : {"friction", "restitution", "rolling_resistance"})
      if (const toml::node* node = material.as_table()->get(key))
        report.warning(node->source(), "materials." + std::string(name.str()) + "." + key,
                       "has no meaning: contact.model is \"none\"");
}

void warn_of_idle_sleep(const toml::table& root, const Scene& scene, Report& report) {
  if (!root.contains("sleep") || !scene.sleep) return;
  const auto warn = [&](const char* why) {
    report.warning(root.get("sleep")->source(), "sleep", std::string("has no meaning: ") + why);
  };
  if (scene.engine == Engine::event_driven) return warn("with engine event_driven nobody falls asleep");
  if (scene.contact == ContactModel::none)
    return warn("contact.model is \"none\", and there is nothing to rest on");
  if (scene.engine != Engine::native) return;
  if (!scene.crowd.groups.empty()) return warn("agents don't sleep");
  if (is_soft(scene.contact)) warn("soft contacts keep bodies awake");
}

/// What has no meaning in this scene, whatever it says.
void warn_of_substeps(const toml::table& root, const Scene& scene, Report& report) {
  const toml::node* substeps = root["time"]["substeps"].node();
  if (!substeps || uses_substeps(scene)) return;
  report.warning(substeps->source(), "time.substeps",
                 scene.engine == Engine::event_driven
                     ? "has no meaning: engine event_driven has no time step"
                     : "has no meaning: agents, and what moves beside them, take the whole step at once");
}

/// Only discs, and those of which composites are, have a radius to roll on.
void warn_of_idle_rolling(const toml::table& root, const Scene& scene, Report& report) {
  if (scene.bodies.size() == 0 || any_round(scene) || scene.contact == ContactModel::none) return;
  for (const Material& material : scene.materials)
    if (material.rolling_resistance > 0.0)
      report.warning(root["materials"][material.name]["rolling_resistance"].node()->source(),
                     "materials." + material.name + ".rolling_resistance",
                     "has no meaning: it holds back discs, and no body is one");
}

/// What only the engine knows, said before anything runs.
void check_engine(const toml::table& root, const Scene& scene, Report& report) {
  std::string refusal;
  if (scene.engine == Engine::box2d) refusal = box2d_refusal(scene);
  if (scene.engine == Engine::event_driven) refusal = event_driven_refusal(scene);
  if (!refusal.empty())
    report.error(*root.get("engine"), "engine", engine_name(scene.engine) + (": " + refusal));
  warn_of_substeps(root, scene, report);
}

/// Bodies may begin so fast that native couldn't take them through a step.
void check_first_step(const toml::table& root, const Scene& scene, Report& report) {
  if (scene.engine != Engine::native) return;
  if (const std::string refusal = period_refusal(scene); !refusal.empty())
    report.error(*root["domain"]["periodic"].node(), "domain.periodic", refusal);
}

void read_scene(const toml::table& root, Scene& scene, Report& report) {
  check(root, grammar(), report);
  if (report.full()) return;  // the rest of the tree was not looked at
  read_settings(root, scene, report);
  read_materials(root, scene, report);
  const std::vector<ShapeDraw> draws = read_shapes(root, scene, report);
  read_observe(root, scene, report);
  read_walls(root, scene, report);
  read_areas(root, scene, report);
  read_opening(root, scene, report);
  read_queues(root, scene, report);
  const std::vector<Entry> entries = read_entries(root, scene, report);
  const std::vector<AgentEntry> agents = read_agents(root, scene, report);
  settle_opening(root, scene, report);
  read_measures(root, scene, report);
  if (report.errors() > 0) return;
  warn_of_idle_borders(root, scene, report);
  place_bodies(entries, draws, scene, report);
  add_bodies_to_floor(entries, scene, report);
  if (report.errors() > 0) return;
  place_agents(agents, scene, report);
  check_queues(root, scene, report);
  check_crowd(root, entries, agents, scene, report);
  read_recorded_bodies(root, scene, report);
  if (report.errors() > 0) return;
  check_region(root, scene, report);
  check_quantum(root, scene, report);
  read_sensors(root, scene, report);
  warn_of_empty_record(root, scene, report);
  warn_of_idle_rolling(root, scene, report);
  warn_of_idle_surfaces(root, scene, report);
  warn_of_idle_sleep(root, scene, report);
  settle_auto_time(root, scene, report);
  settle_contacts(root, scene, report);
  if (report.errors() == 0) check_engine(root, scene, report);
  if (report.errors() == 0) check_first_step(root, scene, report);
  if (report.errors() == 0) check_observe(root, scene, report);
  warn_of_unused(root, scene, report);
}

/// What was chosen stands in the resolved scenario, so that it makes the same run wherever it ends.
void write_chosen_time(toml::table& root, const Time& time) {
  if (!(time.error > 0.0)) return;
  toml::table& table = *root["time"].as_table();
  table.insert_or_assign("dt", time.dt);
  table.insert_or_assign("substeps", std::int64_t{time.substeps});
  table.erase("error");
}

std::vector<Diagnostic> goal_places(const toml::table& root) {
  std::vector<Diagnostic> places;
  for (std::size_t i = 0; const toml::node* goal = root["agents"][i]["goal"].node(); ++i) {
    Report report(root.source().path);
    report.error(*goal, "agents[" + std::to_string(i) + "].goal", "");
    places.push_back(report.take().front());
  }
  return places;
}

void load(Loaded& loaded, const std::string& name, std::span<const std::string> overrides) {
  std::optional<toml::table> root = parse(loaded.text, name, loaded.diagnostics);
  if (!root) return;
  Report report(root->source().path);
  for (const std::string& override_ : overrides) apply_override(*root, override_, report);
  if (root->contains("motion") && !root->contains("throng"))
    report.error(*root->get("motion"), "motion", "this is a motion file; throng motion answers it");
  else
    read_scene(*root, loaded.scene, report);
  write_chosen_time(*root, loaded.scene.time);
  loaded.resolved = print(*root);
  loaded.diagnostics = report.take();
  if (loaded.errors() == 0) loaded.goals = goal_places(*root);
}

}  // namespace

int errors(std::span<const Diagnostic> diagnostics) {
  return static_cast<int>(std::count_if(
      diagnostics.begin(), diagnostics.end(),
      [](const Diagnostic& diagnostic) { return diagnostic.severity == Diagnostic::Severity::error; }));
}

Loaded load_scenario(const std::string& file, std::span<const std::string> overrides) {
  Loaded loaded;
  if (read_source(file, loaded.text, loaded.diagnostics)) load(loaded, file, overrides);
  return loaded;
}

Loaded load_scenario_text(std::string_view text, const std::string& name,
                          std::span<const std::string> overrides) {
  Loaded loaded;
  loaded.text = text;
  load(loaded, name, overrides);
  return loaded;
}

bool says_substeps(const std::string& text) {
  std::vector<Diagnostic> faults;
  const std::optional<toml::table> root = parse(text, "", faults);
  return root && (*root)["time"]["substeps"];
}

std::string to_string(std::span<const Diagnostic> diagnostics, const std::string& file) {
  std::ostringstream out;
  for (const Diagnostic& diagnostic : diagnostics) {
    out << (diagnostic.source.empty() ? file : diagnostic.source);
    if (diagnostic.line > 0) out << ':' << diagnostic.line << ':' << diagnostic.column;
    out << (diagnostic.severity == Diagnostic::Severity::error ? ": error: " : ": warning: ");
    if (!diagnostic.path.empty()) out << diagnostic.path << ": ";
    out << diagnostic.message << '\n';
  }
  return out.str();
}

}  // namespace throng
