// SPDX-License-Identifier: MIT
// What a file names and nothing in it asks for: it may be misspelt elsewhere, or left over.
#include "scenarios/check_use.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "scenarios/path.h"
#include "scenarios/read.h"

namespace throng::scenarios {

namespace {

using Names = std::set<std::string>;

/// What the entries of a list call `key`; `absent` of those that don't say it.
Names names_in(const toml::table& root, const char* entries, const char* key,
               const std::string& absent = "") {
  Names names;
  if (const toml::array* list = root[entries].as_array())
    for (const toml::node& entry : *list)
      if (const std::string name = text(*entry.as_table(), key, absent); !name.empty()) names.insert(name);
  return names;
}

/// Of two or more: "a and b", "a, b and c", "a, b and 19 more".
std::string listed(const std::vector<std::string>& names) {
  const std::size_t n = names.size();
  const std::string first = n > 2 ? names[0] + ", " + names[1] : names[0];
  return first + " and " + (n > 3 ? std::to_string(n - 2) + " more" : names[n - 1]);
}

/// What is said of a name, and of several.
struct Why {
  const char *of_one, *of_many;
};

/// Says at the first of a table's entries that `names` lacks which these are.
void warn_of_others(const toml::table& root, const char* table, const Names& names, const Why& why,
                    Report& report) {
  const toml::table* entries = root[table].as_table();
  if (!entries) return;
  std::vector<std::pair<toml::source_region, std::string>> others;
  for (const auto& [key, node] : *entries)
    if (!names.contains(std::string(key.str()))) others.emplace_back(node.source(), key.str());
  if (others.empty()) return;
  std::ranges::stable_sort(others, {}, [&](const auto& other) {  // from a map to the file's order, --set last
    const auto& [begin, end, path] = other.first;
    return std::tuple(path != entries->source().path, begin.line, begin.column);
  });
  const Path root_path, path(root_path, table);
  if (others.size() == 1)
    return report.warning(others[0].first, Path(path, others[0].second).text(), why.of_one);
  std::vector<std::string> texts;
  for (const auto& [place, name] : others) texts.push_back(Path(root_path, name).text());
  report.warning(others[0].first, path.text(), listed(texts) + " " + why.of_many);
}

/// Walls that have no entry are of the default one.
Names materials_in_use(const toml::table& root) {
  Names names = names_in(root, "bodies", "material", "default");
  names.merge(names_in(root, "walls", "material", "default"));
  if (root["domain"]["box"] || root["walkable"]) names.insert("default");
  return names;
}

Names areas_in_use(const toml::table& root, const Scene& scene) {
  Names names = areas_of_agents(root, scene);
  names.merge(names_in(root, "measure", "area"));
  return names;
}

Names queues_in_use(const Scene& scene) {
  Names names;
  for (const AgentGroup& group : scene.crowd.groups)
    for (const Leg& leg : group.journey)
      if (leg.kind == Leg::Kind::queue)
        for (const std::uint32_t row : leg.options) names.insert(scene.crowd.queues[row].name);
  return names;
}

}  // namespace

std::set<std::string> areas_of_agents(const toml::table& root, const Scene& scene) {
  Names names;
  for (const Area& area : scene.crowd.areas)
    if (area.use != AreaUse::none) names.insert(area.name);
  if (const toml::array* list = root["agents"].as_array())
    for (const toml::node& entry : *list)
      if (const auto* within = (*entry.as_table())["place"]["random"]["within"].as_string())
        names.insert(within->get());
  return names;
}

void warn_of_unused(const toml::table& root, const Scene& scene, Report& report) {
  if (scene.bodies.size() > 0) {  // else it is a collection, or hardly begun
    warn_of_others(root, "materials", materials_in_use(root),
                   {"is of no body and no wall", "are of no body and no wall"}, report);
    warn_of_others(root, "shapes", names_in(root, "bodies", "shape"), {"is of no body", "are of no body"},
                   report);
  }
  warn_of_others(root, "areas", areas_in_use(root, scene),
                 {"is nobody's goal, nobody's place, and not measured: it is only drawn",
                  "are nobody's goals, nobody's places, and not measured: they are only drawn"},
                 report);
  warn_of_others(
      root, "queues", queues_in_use(scene),
      {"is where nobody lines up: it is only drawn", "are where nobody lines up: they are only drawn"},
      report);
}

}  // namespace throng::scenarios
