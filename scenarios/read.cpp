// SPDX-License-Identifier: MIT
#include "scenarios/read.h"

namespace throng::scenarios {

double number(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  return node.as_floating_point()->get();
}

double number(const toml::table& table, std::string_view key, double fallback) {
  const toml::node* node = table.get(key);
  return node ? number(*node) : fallback;
}

std::string text(const toml::table& table, std::string_view key, std::string_view fallback) {
  const toml::node* node = table.get(key);
  return node ? node->as_string()->get() : std::string(fallback);
}

Vec point(const toml::node& node) {
  const toml::array& list = *node.as_array();
  const double x = number(*list.get(0));
  const double y = number(*list.get(1));
  return {x, y};
}

std::vector<Vec> points(const toml::node& node) {
  std::vector<Vec> result;
  for (const toml::node& entry : *node.as_array()) result.push_back(point(entry));
  return result;
}

Eigen::AlignedBox2d box(const toml::node& node) {
  const toml::array& list = *node.as_array();
  return {point(*list.get(0)), point(*list.get(1))};
}

const toml::node* good(const toml::table& table, std::string_view key, const Report& report) {
  const toml::node* node = table.get(key);
  return node && !report.bad(*node) ? node : nullptr;
}

std::uint32_t material_row(const toml::table& table, const Scene& scene) {
  const std::string name = text(table, "material", "default");
  for (std::size_t row = 0; row < scene.materials.size(); ++row)
    if (scene.materials[row].name == name) return static_cast<std::uint32_t>(row);
  return 0;
}

}  // namespace throng::scenarios
