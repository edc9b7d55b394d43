// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/path.h"
#include "scenarios/read_crowd.h"
#include "scenarios/region_sets.h"

namespace throng::scenarios {

namespace {

/// What of the goal is open at that time (s).
GoalPhase phase_at(const Scene& scene, const Goal& goal, double time) {
  std::vector<Region> open;
  for (const std::uint32_t row : goal.areas)
    if (const Area& area = scene.crowd.areas[row]; area.opens <= time && time < area.closes)
      open.push_back(area.region);
  if (open.empty()) return {time, false, goal.region};
  return {time, true, open.size() == goal.areas.size() ? goal.region : united(open)};
}

/// s, when what is open of the goal changes, and 0.
std::vector<double> changes(const Scene& scene, const Goal& goal) {
  std::vector<double> times{0.0};
  for (const std::uint32_t row : goal.areas) {
    times.push_back(scene.crowd.areas[row].opens);
    if (scene.crowd.areas[row].closes < std::numeric_limits<double>::infinity())
      times.push_back(scene.crowd.areas[row].closes);
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

void read_opening(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* open = root.get("open");
  if (!open || !open->is_table()) return;
  const Path root_path, path(root_path, "open");
  for (const auto& [key, node] : *open->as_table()) {
    if (report.bad(node)) continue;
    const std::string name(key.str()), where = Path(path, name).text();
    const std::uint32_t row = area_row(name, scene);
    if (row == scene.crowd.areas.size()) {
      report.error(node, where, "is not the name of an entry of [areas]");
      continue;
    }
    const toml::table& table = *node.as_table();
    Area& area = scene.crowd.areas[row];
    area.opens = number(table, "from", 0.0);
    if (table.contains("until")) area.closes = number(*table.get("until"));
    if (area.closes <= area.opens)
      report.error(node, where, "must be open for some time: `until` above `from`");
  }
}

void settle_opening(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* open = root.get("open");
  if (!open || report.errors() > 0) return;
  const Path root_path, path(root_path, "open");
  for (const auto& [key, node] : *open->as_table()) {
    const std::string name(key.str());
    const AreaUse use = scene.crowd.areas[area_row(name, scene)].use;
    if (use == AreaUse::none) report.error(node, Path(path, name).text(), "is no agents' goal");
    if (use == AreaUse::wait)
      report.error(node, Path(path, name).text(), "is an area to wait in, which can't close");
  }
  for (Goal& goal : scene.crowd.goals) {
    const std::vector<double> times = changes(scene, goal);
    if (times.size() == 1) continue;
    for (const double time : times) goal.phases.push_back(phase_at(scene, goal, time));
  }
}

}  // namespace throng::scenarios
