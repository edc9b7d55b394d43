// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "scenarios/limits.h"
#include "scenarios/read.h"

namespace throng::scenarios {

namespace {

constexpr double kSubstep = 2.5e-3;                  // s: in longer ones contacts sag, and tall stacks fall
constexpr double kFewest = 4.0, kMostOfThem = 40.0;  // substeps, where the scenario doesn't say

int substeps_of(double dt) {
  return static_cast<int>(std::clamp(std::ceil(dt / kSubstep * (1.0 - 1e-9)), kFewest, kMostOfThem));
}

/// A run is made of whole steps.
void warn_of_longer_end(const toml::table& table, const Time& time, Report& report) {
  const double end = static_cast<double>(time.steps()) * time.dt;
  if (!table.contains("until") || std::abs(end - time.until) <= 1e-6 * time.dt) return;
  report.warning(table.get("until")->source(), "time.until",
                 to_text(time.until) + " s is no whole number of steps: the run ends after " +
                     std::to_string(time.steps()) + " of them");
}

/// Only the bodies tell how long steps may be: settle_auto_time() chooses.
void read_wanted_error(const toml::table& table, Time& time, Report& report) {
  time.until = number(table, "until", time.until);
  time.error = number(table, "error", 0.0);
  if (!table.contains("error"))
    report.error(*table.get("dt"), "time.error", "is missing: dt = \"auto\" needs to know what to meet");
  if (const toml::node* substeps = table.get("substeps"))
    report.error(*substeps, "time.substeps",
                 "is chosen, as dt is \"auto\": leave it out; on a command line, replace all of time, as in "
                 "--set 'time={dt=\"auto\", error=0.01, until=10}'");
}

void read_time(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = good(root, "time", report);
  if (!node) return;
  const toml::table& table = *node->as_table();
  Time& time = scene.time;
  if (const toml::node* dt = table.get("dt"); dt && dt->is_string())
    return read_wanted_error(table, time, report);
  if (const toml::node* error = table.get("error"))
    report.error(*error, "time.error",
                 "needs dt = \"auto\", which is chosen for it; leave it out where dt is given");
  time.dt = number(table, "dt", time.dt);
  time.until = number(table, "until", time.until);
  time.substeps = static_cast<int>(number(table, "substeps", substeps_of(time.dt)));
  if (time.until / time.dt <= Time::kMostSteps) return warn_of_longer_end(table, time, report);
  const char* key = table.contains("until") ? "until" : "dt";
  report.error(*table.get(key), std::string("time.") + key,
               "until / dt is " + to_text(time.until / time.dt) + " steps; must be at most " +
                   to_text(Time::kMostSteps));
}

void read_domain(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = good(root, "domain", report);
  if (!node) return;
  const toml::node* walls = node->as_table()->get("box");
  const toml::node& value = walls ? *walls : *node->as_table()->get("periodic");
  const Eigen::AlignedBox2d bounds = box(value);
  scene.domain.kind = walls ? DomainKind::box : DomainKind::periodic;
  scene.domain.min = bounds.min(), scene.domain.max = bounds.max();
  const double side = (bounds.max() - bounds.min()).minCoeff();
  if (side >= kShortestEdge) return;
  report.mark_bad(*node);
  report.error(
      value, walls ? "domain.box" : "domain.periodic",
      side > 0.0 ? "must be at least " + to_text(kShortestEdge) + " m wide and high" : least_first(bounds));
}

}  // namespace

void read_settings(const toml::table& root, Scene& scene, Report& report) {
  if (good(root, "name", report)) scene.name = text(root, "name", "");
  if (good(root, "description", report)) scene.description = text(root, "description", "");
  if (const auto* seed = good(root, "seed", report))
    scene.seed = static_cast<std::uint64_t>(seed->as_integer()->get());
  if (const auto* engine = good(root, "engine", report))
    scene.engine = engine_named(engine->as_string()->get());
  if (const auto* gravity = good(root, "gravity", report)) scene.gravity = point(*gravity);
  if (const auto* sleep = good(root, "sleep", report)) scene.sleep = sleep->as_boolean()->get();
  read_time(root, scene, report);
  read_domain(root, scene, report);
  read_contact(root, scene, report);
  read_record(root, scene, report);
}

void read_materials(const toml::table& root, Scene& scene, const Report& report) {
  scene.materials = {Material{}};
  const toml::node* node = root.get("materials");
  if (!node || !node->is_table()) return;
  for (const auto& [name, entry] : *node->as_table()) {
    Material material;
    material.name = name.str();
    if (!report.bad(entry)) {
      const toml::table& table = *entry.as_table();
      material.density = number(table, "density", material.density);
      material.restitution = number(table, "restitution", material.restitution);
      material.friction = number(table, "friction", material.friction);
      material.rolling_resistance = number(table, "rolling_resistance", material.rolling_resistance);
    }
    if (material.name == "default")
      scene.materials[0] = material;
    else
      scene.materials.push_back(material);
  }
}

}  // namespace throng::scenarios
