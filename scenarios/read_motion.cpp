// SPDX-License-Identifier: MIT
#include "scenarios/read_motion.h"

#include <algorithm>

#include "scenarios/check.h"
#include "scenarios/limits.h"
#include "scenarios/motion_grammar.h"
#include "scenarios/motion_parts.h"
#include "scenarios/source.h"

namespace throng {

using namespace scenarios;

namespace {

/// Who has one waypoint stays there, as all may; all others must have as many as each other. Expects no
/// faults so far.
void match_waypoints(const toml::table& root, MotionTask& task, Report& report) {
  const auto longest = std::max_element(
      task.movers.begin(), task.movers.end(),
      [](const Mover& a, const Mover& b) { return a.waypoints.size() < b.waypoints.size(); });
  if (longest == task.movers.end())
    return report.error(root, "bodies", "is missing: what moves, as [[bodies]] or [[robots]]");
  const std::size_t count = std::max<std::size_t>(2, longest->waypoints.size());
  auto mover = task.movers.begin();
  for (const char* key : {"bodies", "robots"})
    for_each_table(root, key, report, [&](const toml::table& table, const Path& path) {
      const std::size_t own = mover->waypoints.size();
      if (own != 1 && own != count)
        report.error(*table.get("waypoints"), Path(path, "waypoints").text(),
                     "must be 1, or " + std::to_string(count) + " as those of " + longest->name +
                         ", and are " + std::to_string(own));
      mover->waypoints.resize(count, mover->waypoints[0]);
      ++mover;
    });
}

void read_durations(const toml::table& root, MotionTask& task, Report& report) {
  const toml::node* node = root.get("durations");
  if (!node || report.bad(*node)) return;
  for (const toml::node& entry : *node->as_array()) task.durations.push_back(number(entry));
  if (task.waypoints() > 0 && task.durations.size() + 1 != task.waypoints())
    report.error(*node, "durations",
                 "must be as many as segments: " + std::to_string(task.waypoints() - 1) + ", and are " +
                     std::to_string(task.durations.size()));
}

void read_all(const toml::table& root, const std::string& file, MotionTask& task, Report& report) {
  check(root, motion_grammar(), report);
  if (report.full()) return;  // the rest of the tree was not looked at
  if (good(root, "name", report)) task.name = text(root, "name", "");
  if (good(root, "description", report)) task.description = text(root, "description", "");
  if (good(root, "margin", report)) task.margin = number(root, "margin", 0.0);
  Names names;
  read_motion_shapes(root, task, report);
  read_moving_bodies(root, task, names, report);
  read_robots(root, task, names, report);
  if (task.links() > kMostLinks)
    report.error(root, "robots", "make more than " + std::to_string(kMostLinks) + " links, three a body");
  read_obstacles(root, file, task, names, report);
  if (report.errors() > 0) return;
  match_waypoints(root, task, report);
  read_durations(root, task, report);
  read_may_touch(root, task, names, report);
}

void load(const std::string& source, const std::string& name, LoadedMotion& loaded) {
  const std::optional<toml::table> root = parse(source, name, loaded.diagnostics);
  if (!root) return;
  Report report(root->source().path);
  if (root->contains("throng") && !root->contains("motion"))
    report.error(*root->get("throng"), "throng", "this is a scenario; throng run runs it");
  else
    read_all(*root, name, loaded.task, report);
  loaded.diagnostics = report.take();
}

}  // namespace

LoadedMotion load_motion(const std::string& file) {
  LoadedMotion loaded;
  const bool piped = file == "-";
  std::string source;
  if (read_source(piped ? "/dev/stdin" : file, source, loaded.diagnostics))
    load(source, piped ? kStandardInput : file, loaded);
  return loaded;
}

LoadedMotion load_motion_text(const std::string& source, const std::string& name) {
  LoadedMotion loaded;
  load(source, name, loaded);
  return loaded;
}

}  // namespace throng
