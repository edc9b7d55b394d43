// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/path.h"
#include "scenarios/read.h"

namespace throng::scenarios {

namespace {

Screens screens(const toml::node* sight) {
  if (!sight) return Screens::none;
  if (const auto* flag = sight->as_boolean()) return flag->get() ? Screens::walls : Screens::none;
  return sight->as_string()->get() == "bodies" ? Screens::bodies : Screens::walls;
}

void expect_name(const toml::table& table, const Path& path, const Scene& scene, Report& report) {
  const toml::node& node = *table.get("name");
  const std::string name = text(table, "name", "");
  if (name.empty()) report.error(node, path.text() + ".name", "must not be empty");
  if (std::ranges::any_of(scene.sensors, [&](const Sensor& other) { return other.name == name; }))
    report.error(node, path.text() + ".name", in_quotes(name) + " is the name of another sensor too");
}

Sensor read_sensor(const toml::table& table, const Path& path, const Scene& scene, Report& report) {
  expect_name(table, path, scene, report);
  Sensor sensor;
  sensor.name = text(table, "name", "");
  sensor.radius = number(*table.get("radius"));
  sensor.fov = number(table, "fov_degrees", 360.0);
  sensor.screens = screens(table.get("sight"));
  sensor.every = static_cast<int>(number(table, "every", 1.0));
  if (const toml::node* record = table.get("record")) sensor.record = record->as_boolean()->get();
  if (const toml::node* of = table.get("of"); of && of->is_table())
    sensor.ids = fitting_ids(*of->as_table(), path.text() + ".of", scene, report);
  if (sensor.ids.size() == scene.bodies.size()) sensor.ids.clear();
  return sensor;
}

}  // namespace

void read_sensors(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = root.get("sensors");
  if (!node || !node->is_array()) return;
  const Path root_path, path(root_path, "sensors");
  const toml::array& list = *node->as_array();
  if (list.size() > kMostSensors)
    return report.error(
        *node, "sensors",
        "must be at most " + std::to_string(kMostSensors) + ", and are " + std::to_string(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (report.bad(*list.get(i))) continue;
    const Path entry(path, i);
    scene.sensors.push_back(read_sensor(*list.get(i)->as_table(), entry, scene, report));
    if (scene.sensors.back().record) scene.record.sensors.push_back(scene.sensors.back().every);
  }
}

}  // namespace throng::scenarios
