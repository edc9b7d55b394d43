// SPDX-License-Identifier: MIT
// throng bench validation: each model of walking against the catalogues of the field, and experiments.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "sim/input_error.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/rows.h"
#include "tools/bench/validation_cases.h"

namespace throng::bench {

namespace {

using Json = nlohmann::ordered_json;

std::vector<ValidationCase> validation_cases() {
  std::vector<ValidationCase> all;
  for (const auto& part : {lone_cases(), exit_cases(), stream_cases(), choice_cases()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// JSON has no infinity: a bound that isn't there is null.
Json bound(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Else its catalogue asks for what was measured alone.
bool is_judged(const ValidationCase& one) {
  return std::isfinite(one.low) || std::isfinite(one.high);
}

Row judge(const ValidationCase& one, const Trials& trials) {
  const auto begin = std::chrono::steady_clock::now();
  const Finding found = one.measure(trials);
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
  const bool passes =
      found.value && *found.value - found.doubt >= one.low && *found.value + found.doubt <= one.high;
  const char* verdict = !passes ? "fail" : is_judged(one) ? "pass" : "documented";
  const char* nature = passes ? nullptr : by_nature(trials.walker().model, one.name);
  Row row{"validation", one.name, trials.walker().name(), 1, {spent.count()}, 1.0, one.what};
  row.error = {{"verdict", verdict},
               {"value", found.value ? Json(*found.value) : Json(nullptr)},
               {"low", bound(one.low)},
               {"high", bound(one.high)},
               {"unit", one.unit},
               {"note", found.note + (nature ? std::string(found.note.empty() ? "" : "; ") + nature : "")}};
  if (nature) row.error["by_nature"] = true;
  if (found.worst) row.error["doubt"] = found.doubt, row.error["worst"] = *found.worst;
  if (!found.series.empty()) row.error["series"] = found.series;
  return row;
}

std::string figure_text(const Json& number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", number.is_number() ? number.get<double>() : 0.0);
  return number.is_number() ? buffer : "-";
}

/// "+-0.02 (2 s.e.), worst 1.31" where there are several draws.
std::string draws_text(const Json& error) {
  if (!error.contains("worst")) return "";
  const std::string worst = "worst " + figure_text(error["worst"]);
  return error["doubt"] > 0.0 ? "+-" + figure_text(error["doubt"]) + " (2 s.e.), " + worst : worst;
}

/// "0 to 1.33", "at least 0.1", "at most 60".
std::string bounds_text(const Json& error) {
  const Json &low = error.at("low"), &high = error.at("high");
  if (low.is_null() && high.is_null()) return "any";
  if (low.is_null()) return "at most " + figure_text(high);
  return high.is_null() ? "at least " + figure_text(low) : figure_text(low) + " to " + figure_text(high);
}

/// Refuses who isn't there; says who is.
void check_engines(const std::vector<std::string>& engines) {
  const std::vector<Walker> known = walkers();
  std::string there;
  for (const Walker& walker : known) there += "\n  " + walker.name();
  for (const std::string& engine : engines)
    if (std::ranges::find(known, engine, &Walker::name) == known.end())
      throw InputError("validation: --engine: there is no '" + engine + "'; there are" + there);
}

}  // namespace

double doubt(const std::vector<double>& draws) {
  const double n = static_cast<double>(draws.size());
  double squares = 0.0;
  for (const double draw : draws) squares += (draw - mean(draws)) * (draw - mean(draws));
  return 2.0 * std::sqrt(squares / ((n - 1.0) * n));
}

std::vector<Row> bench_validation(const Options& options) {
  check_engines(options.engines);
  std::vector<Trials> all;
  for (const Walker& walker : walkers())
    if (options.engines.empty() || std::ranges::find(options.engines, walker.name()) != options.engines.end())
      all.emplace_back(walker, of_clone("tools/bench/validation"), options.set);
  std::vector<Row> rows;
  for (const ValidationCase& one : validation_cases()) {
    if (!chosen(one.name, options) || (options.quick && !one.quick)) continue;
    for (const Trials& trials : all) {
      std::fprintf(stderr, "%s: %s\n", one.name, trials.walker().name().c_str());
      rows.push_back(judge(one, trials));
      options.show(rows);
    }
  }
  return rows;
}

void print_verdicts(const std::vector<Row>& rows, std::size_t begin) {
  for (std::size_t i = begin; i < rows.size(); ++i) {
    const Row& row = rows[i];
    if (i == 0 || rows[i - 1].name != row.name) std::printf("%s (%s)\n", row.name.c_str(), row.check.c_str());
    const Json& e = row.error;
    const std::string verdict = e["verdict"], unit = e["unit"], note = e["note"];
    std::printf("  %-32s %-10s %9s %-4s  %-16s %-30s %s\n", row.engine.c_str(), verdict.c_str(),
                figure_text(e["value"]).c_str(), unit.c_str(), bounds_text(e).c_str(), draws_text(e).c_str(),
                note.c_str());
  }
}

}  // namespace throng::bench
