// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/check_use.h"
#include "scenarios/path.h"
#include "scenarios/read_crowd.h"
#include "scenarios/region_sets.h"

namespace throng::scenarios {

namespace {

constexpr double kLeast = 0.1 * (1.0 - 1e-9);  // of an area, up to rounding

/// "is 200 s, and the run ends at 100 s (time.until)" of a time.
std::string after_the_end(double time, const Scene& scene) {
  return to_text(time) + " s, and the run ends at " + to_text(scene.time.until) + " s (time.until)";
}

void warn_of_late_measures(const toml::table& root, const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.crowd.measures.size(); ++i) {
    const Measure& measure = scene.crowd.measures[i];
    const toml::node *from = root["measure"][i]["from"].node(), *until = root["measure"][i]["until"].node();
    const std::string path = "measure[" + std::to_string(i) + "].";
    if (from && measure.after >= scene.time.steps())
      report.warning(from->source(), path + "from",
                     "is " + after_the_end(number(*from), scene) + ": nothing is measured");
    else if (until && measure.last > scene.time.steps())
      report.warning(until->source(), path + "until",
                     "is " + after_the_end(number(*until), scene) + ": measured is up to that");
  }
}

/// Of a rate many may be due late, who needn't be counted then to have enough up to the end.
void warn_of_late_agents(const AgentEntry& entry, const Scene& scene, Report& report) {
  const double end = static_cast<double>(scene.time.steps()) * scene.time.dt;
  if (!entry.appears || entry.count == 0 || entry.appears->due(entry.count - 1) <= end) return;
  const auto warn = [&](const char* who, double due, const std::string& what) {
    report.warning(entry.node->as_table()->get("appear")->source(), entry.path + ".appear",
                   std::string("the ") + who + " is due at " + after_the_end(due, scene) + ": " + what);
  };
  if (entry.appears->due(0) > end)
    return warn("first", entry.appears->due(0), "nobody of this group ever appears");
  if (entry.appears->times.empty()) return;
  std::uint32_t late = 1;
  while (entry.appears->due(entry.count - 1 - late) > end) ++late;
  warn("last", entry.appears->due(entry.count - 1),
       std::to_string(late) + " of this group's " + std::to_string(entry.count) + " never appear");
}

/// Who set out after the end, though they are there before it.
void warn_of_late_starters(const AgentEntry& entry, const AgentGroup& group, const Scene& scene,
                           Report& report) {
  const toml::node* node = entry.node->as_table()->get("premovement");
  if (!node || group.count == 0 || (entry.appears && entry.appears->due(0) > scene.time.until)) return;
  const auto start = std::span(scene.crowd.start).subspan(group.first, group.count);
  const double first = *std::ranges::min_element(start);
  if (first < scene.time.until) return;
  report.warning(
      node->source(), entry.path + ".premovement",
      "the first sets out at " + after_the_end(first, scene) + ": nobody of this group ever walks");
}

/// A goal that is closed all the time.
void warn_of_late_openings(const toml::table& root, const Scene& scene, Report& report) {
  for (const Area& area : scene.crowd.areas)
    if (area.opens > 0.0 && area.opens >= scene.time.until)
      report.warning(root["open"][area.name]["from"].node()->source(), "open." + area.name + ".from",
                     "is " + after_the_end(area.opens, scene) + ": it never opens");
}

/// Of several of which agents go to the nearest the others would do, and nobody would know. A door may be
/// drawn astride a wall; one of which next to nothing is walkable is in the wrong place. What is only
/// measured is so over the walkable part.
void expect_areas_on_the_floor(const toml::table& root, const Scene& scene, Report& report) {
  const Path root_path, path(root_path, "areas");
  const std::set<std::string> used = areas_of_agents(root, scene);
  for (const Area& area : scene.crowd.areas) {
    if (!used.contains(area.name)) continue;
    const toml::node& node = *root["areas"][area.name].node();
    const double all = common_area(area.region, area.region);
    const double walkable = common_area(area.region, scene.crowd.walkable);
    if (area.use != AreaUse::none && !(walkable > 0.0))
      report.error(node, Path(path, area.name).text(),
                   "has nothing in common with the walkable area, and agents are to go there");
    else if (walkable < kLeast * all)
      report.warning(node.source(), Path(path, area.name).text(),
                     three_digits(walkable) + " of its " + three_digits(all) + " m² are walkable");
  }
}

/// m/s, of which there is one an agent of a group.
std::span<const double> desired_speeds(const AgentGroup& group, const Scene& scene) {
  return std::span(scene.crowd.desired_speed).subspan(group.first, group.count);
}

void warn_of_standers(const AgentEntry& entry, const AgentGroup& group, const Scene& scene, Report& report) {
  const toml::node* node = entry.node->as_table()->get("desired_speed");
  const auto all = desired_speeds(group, scene);
  if (!node || all.empty() || std::ranges::any_of(all, [](double speed) { return speed > 0.0; })) return;
  report.warning(node->source(), entry.path + ".desired_speed",
                 "is 0: they stand, and never get to their goal");
}

/// Ways lead round static bodies alone.
void warn_of_still_bodies(std::span<const Entry> bodies, Report& report) {
  for (const Entry& entry : bodies)
    if (entry.kind == BodyKind::kinematic && !entry.maxwell && entry.velocity == Vec(0.0, 0.0) &&
        entry.spin == 0.0)
      report.warning(entry.node->as_table()->get("kind")->source(),
                     "bodies[" + std::to_string(entry.index) + "].kind",
                     "is \"kinematic\", and the body never moves: agents don't find their way round it, as "
                     "they do round what is \"static\"");
}

}  // namespace

void check_crowd(const toml::table& root, std::span<const Entry> bodies, std::span<const AgentEntry> agents,
                 const Scene& scene, Report& report) {
  if (agents.empty() || report.errors() > 0) return;
  expect_areas_on_the_floor(root, scene, report);
  warn_of_late_measures(root, scene, report);
  warn_of_late_openings(root, scene, report);
  warn_of_still_bodies(bodies, report);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    warn_of_late_agents(agents[i], scene, report);
    warn_of_late_starters(agents[i], scene.crowd.groups[i], scene, report);
    warn_of_standers(agents[i], scene.crowd.groups[i], scene, report);
  }
}

}  // namespace throng::scenarios
