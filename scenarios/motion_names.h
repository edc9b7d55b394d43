// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scenarios/motion_task.h"
#include "scenarios/path.h"
#include "scenarios/report.h"

namespace throng::scenarios {

/// What the things of a motion file are called.
class Names {
 public:
  /// Reports a name that something else has, or that all obstacles have together.
  void add(const std::string& name, Solids solids, const toml::node& node, const Path& path, Report& report);

  /// All of them together, as "obstacles".
  void add_obstacles(Solids solids) { solids_.emplace(kObstacles, solids); }

  /// Null where nothing is called so.
  const Solids* find(const std::string& name) const;

  /// At most a thousand of them, for suggestions.
  std::vector<std::string> some() const;

 private:
  static constexpr const char* kObstacles = "obstacles";

  std::map<std::string, Solids> solids_;
};

}  // namespace throng::scenarios
