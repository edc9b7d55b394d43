// SPDX-License-Identifier: MIT
// throng bench stability: a stack, a pile and a gas under stress, factor by factor and in pairs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "tools/bench/benchmarks.h"
#include "tools/bench/stability/verdict.h"

namespace throng::bench {

namespace {

using Json = nlohmann::ordered_json;

/// Those that make each other worse.
constexpr std::pair<Factor, Factor> kFactorPairs[] = {{Factor::dt, Factor::substeps},
                                                      {Factor::dt, Factor::mass_ratio},
                                                      {Factor::scale, Factor::dt},
                                                      {Factor::scale, Factor::offset}};

Json or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string value_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

Row row_of(Stressed scene, const std::string& name, const Stress& stress) {
  const Endured seen = endure(scene, stress);
  Json error{{"verdict", verdict_name(seen.verdict)},
             {"energy", or_null(seen.energy)},
             {"overlap", seen.end.empty() ? or_null(seen.overlap) : Json(nullptr)},
             {"speed", or_null(seen.speed)},
             {"scene", stressed_name(scene)}};
  if (scene == Stressed::stack) error["moved"] = or_null(seen.moved);
  if (!seen.end.empty()) error["end"] = seen.end;
  return {"stability", name, "native", 1, {seen.ms}, static_cast<double>(seen.steps), "", error};
}

void add_axis(Row& row, const char* axis, Factor factor, double value) {
  row.error[axis] = factor_name(factor);
  row.error[std::string(axis) + "_value"] = value;
}

void add_lines(Stressed scene, const Options& options, std::vector<Row>& rows) {
  for (std::size_t i = 0; i < kFactors; ++i) {
    const Factor factor = static_cast<Factor>(i);
    const std::string name = stressed_name(scene) + std::string(": ") + factor_name(factor);
    if (!chosen(name, options)) continue;
    for (const double value : values_of(factor, options.quick)) {
      Stress stress = ordinary(scene);
      stress[i] = value;
      rows.push_back(row_of(scene, name, stress));
      add_axis(rows.back(), "x", factor, value);
      options.show(rows);
    }
  }
}

void add_maps(Stressed scene, const Options& options, std::vector<Row>& rows) {
  for (const auto& [x, y] : kFactorPairs) {
    const std::string name =
        stressed_name(scene) + std::string(": ") + factor_name(x) + ", " + factor_name(y);
    if (options.quick || !chosen(name, options)) continue;
    for (const double at_y : values_of(y, false))
      for (const double at_x : values_of(x, false)) {
        Stress stress = ordinary(scene);
        stress[static_cast<std::size_t>(x)] = at_x, stress[static_cast<std::size_t>(y)] = at_y;
        rows.push_back(row_of(scene, name, stress));
        add_axis(rows.back(), "x", x, at_x), add_axis(rows.back(), "y", y, at_y);
        options.show(rows);
      }
  }
}

void print_cell(const Row& row) {
  const Json& e = row.error;
  const auto figure = [&](const char* key) {
    return e.contains(key) && e[key].is_number() ? value_text(e[key].get<double>()) : std::string("-");
  };
  std::string at = value_text(e["x_value"].get<double>());
  if (e.contains("y")) at += ", " + value_text(e["y_value"].get<double>());
  std::printf("  %-18s %-9s %10s %10s %10s %10s\n", at.c_str(), e["verdict"].get<std::string>().c_str(),
              figure("energy").c_str(), figure("overlap").c_str(), figure("speed").c_str(),
              figure("moved").c_str());
}

}  // namespace

std::vector<Row> bench_stability(const Options& options) {
  std::vector<Row> rows;
  for (const Stressed scene : kStressed) {
    std::fprintf(stderr, "%s\n", stressed_name(scene));
    add_lines(scene, options, rows);
    add_maps(scene, options, rows);
  }
  return rows;
}

void print_stability(const std::vector<Row>& rows, std::size_t begin) {
  for (std::size_t i = begin; i < rows.size(); ++i) {
    const Row& row = rows[i];
    if (i == 0 || rows[i - 1].name != row.name)
      std::printf("%s\n  %-18s %-9s %10s %10s %10s %10s\n", row.name.c_str(), "", "", "energy", "overlap",
                  "speed", "moved");
    print_cell(row);
  }
}

void print_stable(const std::vector<Row>& rows) {
  const auto stable =
      std::ranges::count_if(rows, [](const Row& row) { return row.error["verdict"] == "stable"; });
  std::printf("%td of %zu are stable\n", stable, rows.size());
}

}  // namespace throng::bench
