// SPDX-License-Identifier: MIT
// throng bench accuracy: run time against error, each scene on each engine at several settings.
#include <algorithm>
#include <cstdio>
#include <span>
#include <string>

#include "sim/input_error.h"
#include "tools/bench/accuracy/convergence.h"
#include "tools/bench/accuracy/equal_error.h"
#include "tools/bench/accuracy/players.h"
#include "tools/bench/accuracy/question_rows.h"
#include "tools/bench/accuracy/race.h"
#include "tools/bench/benchmarks.h"

namespace throng::bench {

namespace {

std::vector<AccuracyCase> accuracy_cases() {
  std::vector<AccuracyCase> all;
  for (const auto& part :
       {flight_cases(), contact_cases(), collision_cases(), spring_cases(), still_cases(), gas_cases()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// "dt 0.01, substeps 4".
std::string setting_text(const nlohmann::ordered_json& error) {
  if (error["dt"].is_null()) return error["setting"];
  char dt[32];
  std::snprintf(dt, sizeof dt, "dt %.5g", error["dt"].get<double>());
  const std::string knob = error["setting"];
  return knob.empty() ? dt : dt + (", " + knob);
}

void print_row(const Row& row) {
  const auto& e = row.error;
  if (e["error"].is_null()) {
    std::printf("  %-13s can't: %s\n", row.engine.c_str(), e["note"].get<std::string>().c_str());
    return;
  }
  std::printf("  %-13s %-26s %11.4g %11.4g %11.3g", row.engine.c_str(), setting_text(e).c_str(),
              median(row.ms), minimum(row.ms), e["error"].get<double>());
  if (e.contains("asked")) std::printf("  asked %.3g", e["asked"].get<double>());
  if (e.contains("native_ms") && e["native_ms"].is_number())
    std::printf("  native is %.3g times as fast", minimum(row.ms) / e["native_ms"].get<double>());
  else if (e.contains("native_ms"))
    std::printf("  native isn't that exact");
  std::printf("\n");
}

void print_advantage(const std::vector<Row>& rows) {
  const std::optional<Advantage> found = advantage(rows);
  if (!found) return;
  if (found->most > 0.0)
    std::printf("  at the best peers' errors native is %.3g to %.3g times as fast\n", found->least,
                found->most);
  if (!found->beyond.empty())
    std::printf("  peers get to errors of %.3g where native at these settings doesn't\n",
                *std::ranges::min_element(found->beyond));
}

/// Calls visit(rows) for the rows of each case.
template <class Visit>
void for_each_case(std::span<const Row> rows, Visit visit) {
  for (auto begin = rows.begin(); begin != rows.end();) {
    const auto end = std::find_if(begin, rows.end(), [&](const Row& row) { return row.name != begin->name; });
    visit(std::vector<Row>(begin, end));
    begin = end;
  }
}

void refuse_unknown_engines(const Options& options) {
  std::string known;
  for (const Player& player : players()) known += (known.empty() ? "" : ", ") + std::string(player.engine);
  const auto is_known = [](const std::string& engine) {
    return std::ranges::any_of(players(), [&](const Player& player) { return engine == player.engine; });
  };
  for (const std::string& engine : options.engines)
    if (!is_known(engine))
      throw InputError("accuracy: --engine " + engine + ": is none; engines are " + known);
}

}  // namespace

std::vector<Row> bench_accuracy(const Options& options) {
  refuse_unknown_engines(options);
  std::vector<Row> rows;
  for (const AccuracyCase& one : accuracy_cases()) {
    if (!chosen(one.name, options)) continue;
    std::vector<Row> of_case = race(one, options);
    if (one.smooth) add_orders(of_case);
    add_native_ms(of_case);
    rows.insert(rows.end(), of_case.begin(), of_case.end());
    options.show(rows);
  }
  for_each_case(question_rows(options), [&](std::vector<Row> of_case) {
    add_native_ms(of_case);
    rows.insert(rows.end(), of_case.begin(), of_case.end());
  });
  return rows;
}

void print_accuracy(const std::vector<Row>& rows, std::size_t begin) {
  for_each_case(std::span(rows).subspan(begin), [](const std::vector<Row>& of_case) {
    std::printf("%s: %s\nError: %s.\n  %-13s %-26s %11s %11s %11s\n", of_case[0].name.c_str(),
                of_case[0].check.c_str(), of_case[0].error["what"].get<std::string>().c_str(), "engine",
                "setting", "ms/s", "least", "error");
    for (const Row& row : of_case) print_row(row);
    print_advantage(of_case);
  });
}

void print_orders(const std::vector<Row>& rows) {
  print_convergence(rows);
}

}  // namespace throng::bench
