// SPDX-License-Identifier: MIT
// What a file names and nothing in it asks for: it may be misspelt elsewhere, or left over.
#include <algorithm>
#include <set>
#include <string>

#include "scenarios/path.h"
#include "scenarios/read_crowd.h"

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

/// Calls f(name, node) for all entries of a table that `names` lacks.
template <class F>
void for_each_other(const toml::table& root, const char* table, const Names& names, F f) {
  if (const toml::table* entries = root[table].as_table())
    for (const auto& [key, node] : *entries)
      if (const std::string name(key.str()); !names.contains(name)) f(name, node);
}

void warn_of_others(const toml::table& root, const char* table, const Names& names, const char* why,
                    Report& report) {
  const Path root_path, path(root_path, table);
  for_each_other(root, table, names, [&](const std::string& name, const toml::node& node) {
    report.warning(node.source(), Path(path, name).text(), why);
  });
}

/// Walls that have no entry are of the default one.
Names materials_in_use(const toml::table& root) {
  Names names = names_in(root, "bodies", "material", "default");
  names.merge(names_in(root, "walls", "material", "default"));
  if (root["domain"]["box"] || root["walkable"]) names.insert("default");
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

std::set<std::string> areas_in_use(const toml::table& root, const Scene& scene) {
  Names names = names_in(root, "measure", "area");
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
    warn_of_others(root, "materials", materials_in_use(root), "is of no body and no wall", report);
    warn_of_others(root, "shapes", names_in(root, "bodies", "shape"), "is of no body", report);
  }
  warn_of_others(root, "areas", areas_in_use(root, scene),
                 "is nobody's goal, nobody's place, and not measured: it is only drawn", report);
  warn_of_others(root, "queues", queues_in_use(scene), "nobody lines up there: it is only drawn", report);
}

}  // namespace throng::scenarios
