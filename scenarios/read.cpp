// SPDX-License-Identifier: MIT
#include "scenarios/read.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/relative.h"
#include "scenarios/limits.h"

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

std::string to_text(const Vec& place) {
  return "[" + to_text(place.x()) + ", " + to_text(place.y()) + "]";
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

std::string lower_first(const Vec& bounds) {
  return "must have its lower bound first, and is " + to_text(bounds);
}

std::string least_first(const Eigen::AlignedBox2d& box) {
  return "must have its least x and y first, [[min x, min y], [max x, max y]], and is [" +
         to_text(Vec(box.min())) + ", " + to_text(Vec(box.max())) + "]";
}

std::string too_short(std::span<const Vec> line, bool closed) {
  for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
    const Vec edge = line[(i + 1) % line.size()] - line[i];
    const double length = narrowphase::direction(edge, edge).length;  // a norm would square it to 0
    if (length > 0.0 && length < kShortestEdge)
      return "has points " + to_text(length) + " m apart; must be equal or at least " +
             to_text(kShortestEdge) + " m apart";
  }
  return "";
}

const toml::node* good(const toml::table& table, std::string_view key, const Report& report) {
  const toml::node* node = table.get(key);
  return node && !report.bad(*node) ? node : nullptr;
}

std::uint32_t material_row(const toml::table& table, const Scene& scene) {
  const std::string name = text(table, "material", "default");
  if (name == "default" || scene.materials.empty()) return 0;
  const auto found =
      std::lower_bound(scene.materials.begin() + 1, scene.materials.end(), name,
                       [](const Material& material, const std::string& n) { return material.name < n; });
  return found == scene.materials.end() ? 0 : static_cast<std::uint32_t>(found - scene.materials.begin());
}

}  // namespace throng::scenarios
