// SPDX-License-Identifier: MIT
#include "scenarios/motion_names.h"

namespace throng::scenarios {

void Names::add(const std::string& name, Solids solids, const toml::node& node, const Path& path,
                Report& report) {
  if (name == kObstacles)
    return report.error(node, path.text(),
                        "is called " + in_quotes(name) + ", which stands for all obstacles");
  if (solids_.emplace(name, solids).second) return;
  report.error(node, path.text(), "is called " + in_quotes(name) + ", as something before it");
}

const Solids* Names::find(const std::string& name) const {
  const auto found = solids_.find(name);
  return found == solids_.end() ? nullptr : &found->second;
}

std::vector<std::string> Names::some() const {
  constexpr std::size_t kMostNames = 1000;
  std::vector<std::string> result;
  for (const auto& [name, solids] : solids_)
    if (result.size() < kMostNames) result.push_back(name);
  return result;
}

}  // namespace throng::scenarios
