// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/question_rows.h"

#include <limits>
#include <string>

#include "tools/bench/benchmarks.h"

namespace throng::bench {

namespace {

using Json = nlohmann::ordered_json;

struct Question {
  const char* name;
  const char* what;
  const char* error;
  const char* source;  // the case of the other benchmark
  std::vector<Row> (*ask)(const Options&);
  const char* figure;  // of its rows that is the error
  double unit;         // of it
  const char* own;     // throng's engine, that the others are held against; "" where all are
};

const Question kQuestions[] = {
    {"when do octagons meet",
     "A thousand pairs of octagons fly and turn; half of them meet. Exact: 50 digits.",
     "how far apart or deep in each other at the worst first contact, of their size", "^octagons, random$",
     bench_motion, "gap", 1.0, "first contact"},
    {"how far apart are octagons", "Pairs of octagons that come near each other. Exact: long double.",
     "the worst distance, of their scale", "^coherent 8 vertices 0.1 rad near$", bench_narrowphase, "max_ulp",
     std::numeric_limits<double>::epsilon(), "tracker"},
    {"distances to a tolerance",
     "Coastlines of 16,384 edges near each other, each distance to within a part a of it. Exact: a = 0.",
     "the worst distance, relative", "^within a mixed near coast n=(256|16384)$", bench_bvh, "worst", 1.0,
     ""},
};

/// As the laboratory's lines are called: throng's own answer is native's, also to a tolerance; the others'
/// first or last words say how they are set.
std::pair<std::string, std::string> line_and_setting(const Question& question, const std::string& engine) {
  if (engine == question.own) return {"native", ""};
  if (engine.starts_with("a=")) return {"native", engine};
  const std::size_t space = engine.find(' ');
  if (space == engine.npos) return {engine, ""};
  const std::string first = engine.substr(0, space), rest = engine.substr(space + 1);
  return rest == "advancement" ? std::pair(rest, first) : std::pair(first, rest);
}

void add(const Question& question, const Options& options, std::vector<Row>& rows) {
  Options other = options;
  other.only = {question.source};
  for (const Row& answered : question.ask(other)) {
    if (!answered.error.contains(question.figure)) continue;
    const auto [engine, setting] = line_and_setting(question, answered.engine);
    Json error{{"error", question.unit * answered.error[question.figure].get<double>()},
               {"dt", nullptr},
               {"setting", setting},
               {"what", question.error}};
    if (engine == "box2d" || engine == "cgal") error["peer"] = true;
    Row row{"accuracy", question.name, engine, 1, {}, answered.work, question.what, error};
    for (const double ms : answered.ms) row.ms.push_back(1e3 * ms);
    rows.push_back(std::move(row));
  }
}

}  // namespace

std::vector<Row> question_rows(const Options& options) {
  std::vector<Row> rows;
  Options all = options;
  all.engines.clear();
  all.show = Options().show;  // nobody: those rows are other benchmarks'
  for (const Question& question : kQuestions)
    if (chosen(question.name, options) && options.engines.empty()) add(question, all, rows);
  return rows;
}

}  // namespace throng::bench
