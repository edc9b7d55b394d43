// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/convergence.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

namespace throng::bench {

namespace {

constexpr double kSingleRounding = 1e-5, kTooLarge = 10.0;  // of single precision's runs; of a body's size
constexpr double kExact = 1e-9;
constexpr std::size_t kFewest = 3;

/// Rows of an engine that differ in dt alone.
std::string line_of(const Row& row) {
  return row.engine + " " + row.error["setting"].get<std::string>();
}

std::string order_text(const Row& row) {
  if (row.error.contains("exact")) return "exact";
  if (!row.error.contains("order") || row.error["order"].is_null()) return "-";
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", row.error["order"].get<double>());
  return text;
}

}  // namespace

std::optional<double> observed_order(std::span<const std::pair<double, double>> points) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [h, error] : points) {
    if (error < kSingleRounding || error > kTooLarge) continue;
    const double log_h = std::log(h), log_error = std::log(error);
    n += 1.0, x += log_h, y += log_error, xx += log_h * log_h, xy += log_h * log_error;
  }
  if (n < kFewest) return {};
  return (n * xy - x * y) / (n * xx - x * x);
}

void add_orders(std::vector<Row>& rows) {
  std::map<std::string, std::vector<std::pair<double, double>>> lines;
  for (const Row& row : rows)
    if (!row.error["error"].is_null()) lines[line_of(row)].push_back({row.error["dt"], row.error["error"]});
  for (Row& row : rows) {
    const auto& points = lines[line_of(row)];
    if (points.empty()) continue;
    const std::optional<double> order = observed_order(points);
    row.error["order"] = order ? nlohmann::ordered_json(*order) : nlohmann::ordered_json(nullptr);
    if (std::ranges::all_of(points, [](const auto& point) { return point.second < kExact; }))
      row.error["exact"] = true;
  }
}

void print_convergence(const std::vector<Row>& rows) {
  std::vector<std::string> scenes, engines;
  std::map<std::pair<std::string, std::string>, std::string> orders;
  for (const Row& row : rows) {
    if (!row.error.contains("order")) continue;
    if (std::ranges::find(scenes, row.name) == scenes.end()) scenes.push_back(row.name);
    if (std::ranges::find(engines, row.engine) == engines.end()) engines.push_back(row.engine);
    orders.try_emplace({row.name, row.engine}, order_text(row));
  }
  if (scenes.empty()) return;
  std::printf("\nobserved order: error = c dt^order%*s", 2, "");
  for (const std::string& engine : engines) std::printf("%14s", engine.c_str());
  for (const std::string& scene : scenes) {
    std::printf("\n  %-34s", scene.c_str());
    for (const std::string& engine : engines) {
      const auto found = orders.find({scene, engine});
      std::printf("%14s", found == orders.end() ? "" : found->second.c_str());
    }
  }
  std::printf("\n");
}

}  // namespace throng::bench
