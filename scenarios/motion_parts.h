// SPDX-License-Identifier: MIT
#pragma once

#include "scenarios/motion_names.h"
#include "scenarios/path.h"
#include "scenarios/read.h"

/// From a checked tree to a motion task, a part each, as read.h does for scenarios.
namespace throng::scenarios {

/// All shapes by name. One with a fault in it keeps its row, empty.
void read_motion_shapes(const toml::table& root, MotionTask& task, Report& report);

void read_moving_bodies(const toml::table& root, MotionTask& task, Names& names, Report& report);
void read_robots(const toml::table& root, MotionTask& task, Names& names, Report& report);

/// [[obstacles]], [[walls]], then the surroundings, which lie beside `file`. Expects the task's movers.
void read_obstacles(const toml::table& root, const std::string& file, MotionTask& task, Names& names,
                    Report& report);

/// Expects all names.
void read_may_touch(const toml::table& root, MotionTask& task, const Names& names, Report& report);

/// The shape of that name. O(log n). Expects that there is one.
std::uint32_t shape_row(const MotionTask& task, const std::string& name);

/// The table's own name, or `fallback`.
std::string name_or(const toml::table& table, const std::string& fallback);

/// [x, y] or [x, y, angle]; without an angle `fallback`.
std::vector<double> pose_values(const toml::node& node, double fallback);

/// The list at the root's `key` with its path, entry by entry: visit(table, path) of those without fault.
template <class Visit>
void for_each_table(const toml::table& root, std::string_view key, const Report& report, Visit visit) {
  const toml::node* node = root.get(key);
  if (!node || !node->is_array()) return;
  const Path root_path, list_path(root_path, key);
  std::size_t index = 0;
  for (const toml::node& entry : *node->as_array()) {
    const Path path(list_path, index++);
    if (!report.bad(entry)) visit(*entry.as_table(), path);
  }
}

}  // namespace throng::scenarios
