// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>
#include <string>

#include "scenarios/read.h"
#include "sim/measure/measured_bodies.h"

namespace throng::scenarios {

namespace {

Bins bins(const toml::table& table, const char* key) {
  const toml::node* node = table.get(key);
  if (!node) return {};
  const toml::table& of = *node->as_table();
  return {number(*of.get("up_to")), static_cast<int>(number(of, "bins", 50.0))};
}

void read_quantities(const toml::table& table, Asked& asked) {
  const toml::node* list = table.get("quantities");
  const auto wanted = [&](const char* name) {
    return list && std::any_of(list->as_array()->begin(), list->as_array()->end(),
                               [&](const toml::node& one) { return one.as_string()->get() == name; });
  };
  asked.temperature = wanted("temperature");
  asked.packing_fraction = wanted("packing_fraction");
  asked.coordination_number = wanted("coordination_number");
  asked.collisions = wanted("collisions");
  asked.compressibility_factor = wanted("compressibility_factor");
}

/// The box in which something is taken that is `asked` for; nothing where there is no such key.
std::optional<Eigen::AlignedBox2d> within(const toml::table& table, const std::string& key, bool asked,
                                          const std::string& what, Report& report) {
  const toml::node* node = table.get(key);
  if (!node) return std::nullopt;
  const Eigen::AlignedBox2d result = box(*node);
  if (!asked)
    report.error(*node, "observe." + key, what + ", which isn't asked for");
  else if (!(result.sizes().minCoeff() > 0.0))
    report.error(*node, "observe." + key, least_first(result));
  return result;
}

}  // namespace

void read_observe(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = good(root, "observe", report);
  if (!node) return;
  const toml::table& table = *node->as_table();
  Asked& asked = scene.asked;
  read_quantities(table, asked);
  asked.speeds = bins(table, "speeds");
  asked.pair_correlation = bins(table, "pair_correlation");
  asked.packing_within =
      within(table, "packing_within", asked.packing_fraction, "is where packing_fraction is taken", report);
  asked.correlation_within = within(table, "correlation_within", static_cast<bool>(asked.pair_correlation),
                                    "holds those of whom pair_correlation is", report);
}

void check_observe(const toml::table& root, const Scene& scene, Report& report) {
  const auto [key, why] = asked_refusal(scene);
  if (why.empty()) return;
  const toml::node* node = root["observe"].at_path(key).node();
  report.error(node ? *node : *root.get("observe"), "observe" + (key.empty() ? "" : "." + key), why);
}

}  // namespace throng::scenarios
