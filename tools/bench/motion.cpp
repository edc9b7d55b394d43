// SPDX-License-Identifier: MIT
// throng bench motion: do moving solids meet, and when first; run time against error.
#include <algorithm>
#include <cmath>
#include <map>

#include "tools/bench/benchmarks.h"
#include "tools/bench/motion_engines.h"
#include "tools/bench/motion_linkage.h"
#include "tools/bench/motion_timing.h"
#include "tools/bench/motion_truth.h"

namespace throng::bench {

namespace {

using namespace narrowphase;
using HitTimes = std::vector<std::optional<double>>;

/// What an engine said, query by query, as far as there was time for it.
struct Answers {
  std::vector<Told> told;
  double evaluations = 0.0;  ///< mean
};

Answers ask_all(const MotionEngine& engine, std::size_t queries, double seconds) {
  Answers answers;
  double evaluations = 0.0;
  ask_in_turn(queries, seconds, [&](std::size_t i) {
    answers.told.push_back(engine.ask(i));
    evaluations += static_cast<double>(answers.told.back().evaluations);
  });
  answers.evaluations = evaluations / static_cast<double>(answers.told.size());
  return answers;
}

struct Faults {
  int missed = 0, false_hits = 0, undecided = 0;
  double time = 0.0,
         gap = 0.0;  ///< s, and of the size: the largest errors of a hit's time, and of its contact
};

Faults faults(const MotionCase& c, const MotionEngine& engine, const Answers& answers,
              const HitTimes& truth) {
  Faults f;
  for (std::size_t i = 0; i < answers.told.size(); ++i) {
    const Told& told = answers.told[i];
    f.undecided += told.verdict == Verdict::undecided;
    f.missed += told.verdict == Verdict::free && truth[i];
    f.false_hits += told.verdict == Verdict::hit && !truth[i];
    if (told.verdict != Verdict::hit || !truth[i] || !engine.first) continue;
    f.time = std::max(f.time, std::abs(told.time - *truth[i]));
    f.gap = std::max(f.gap, std::abs(exact_gap(c.queries[i], told.time)) / c.size);
  }
  return f;
}

/// All engines of a case have the truth's check, but who promises to be exact and isn't.
std::string check(const MotionEngine& engine, const Faults& f, const HitTimes& truth) {
  const auto hits = std::ranges::count_if(truth, [](const auto& time) { return time.has_value(); });
  std::string text = std::to_string(hits) + " of " + std::to_string(truth.size()) + " hit";
  const int wrong = engine.promise == Promise::exact ? f.missed + f.false_hits : 0;
  if (wrong + (engine.promise == Promise::filter ? f.missed : 0) > 0)
    text += ", but " + std::to_string(f.missed) + " missed and " + std::to_string(f.false_hits) + " false";
  return text;
}

Row row(const MotionCase& c, const MotionEngine& engine, const Answers& answers, const HitTimes& truth) {
  const Faults f = faults(c, engine, answers, truth);
  Row result{"motion",
             c.name,
             engine.name,
             1,
             {},
             static_cast<double>(answers.told.size()),
             check(engine, f, truth)};
  result.error = {{"evaluations", answers.evaluations},
                  {"missed", f.missed},
                  {"false_hits", f.false_hits},
                  {"undecided", f.undecided}};
  if (engine.first && f.time + f.gap > 0.0) result.error["time"] = f.time, result.error["gap"] = f.gap;
  return result;
}

/// Of the queries that hit, the median share of another's evaluations that an engine needs.
double share(const Answers& mine, const Answers& other, const HitTimes& truth) {
  std::vector<double> shares;
  for (std::size_t i = 0; i < std::min(mine.told.size(), other.told.size()); ++i)
    if (truth[i] && other.told[i].evaluations > 0)
      shares.push_back(static_cast<double>(mine.told[i].evaluations) /
                       static_cast<double>(other.told[i].evaluations));
  return shares.empty() ? 0.0 : median(std::move(shares));
}

/// Whether an engine goes from contact-free time to contact-free time, as the bisection doesn't.
bool is_sequential(const MotionEngine& engine) {
  return engine.name == "first contact" || engine.name.ends_with("advancement");
}

/// The first engine is the bisection, which answers everything.
std::vector<Row> run(MotionCase c, const Options& options) {
  const HitTimes times = truth(c);
  const std::vector<MotionEngine> engines = motion_engines(c, options.quick);
  std::vector<Row> rows;
  Answers first;
  std::vector<AskOne> ask;
  for (const MotionEngine& engine : engines) {
    const double seconds = rows.empty() ? kAllOfThem : options.quick ? 0.005 : 0.02;
    Answers answers = ask_all(engine, c.queries.size(), seconds);
    rows.push_back(row(c, engine, answers, times));
    ask.push_back([&engine](std::size_t i) { return engine.ask(i).time; });
    if (rows.size() == 1)
      first = std::move(answers);
    else if (const double part = share(first, answers, times); is_sequential(engine) && part > 0.0)
      rows[0].error["of " + engine.name] = part;
  }
  expect_agreement(rows);
  time_rows(rows, ask, options.blocks);
  return rows;
}

void append(std::vector<Row>& rows, std::vector<Row> more) {
  for (Row& row : more) rows.push_back(std::move(row));
}

/// Bars past a post, ever nearer: `growth` is the power of 1 / clearance that evaluations have grown with
/// since the last clearance.
void add_bars(const Options& options, std::vector<Row>& rows) {
  std::map<std::string, std::pair<double, double>> last;
  for (const double clearance : {1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001, 1e-4, 1e-6, 1e-9, -0.03}) {
    if (options.quick && clearance != 1.0 && clearance != 1e-4 && clearance > 0.0) continue;
    MotionCase c = bar_past_post(clearance, options.quick ? 4 : 32);
    if (!chosen(c.name, options)) continue;
    for (Row& row : run(std::move(c), options)) {
      const double evaluations = row.error["evaluations"];
      if (const auto before = last.find(row.engine);
          before != last.end() && clearance > 0.0 && evaluations > 0.0)
        row.error["growth"] =
            std::log(evaluations / before->second.second) / std::log(before->second.first / clearance);
      last[row.engine] = {clearance, evaluations};
      rows.push_back(std::move(row));
    }
  }
}

}  // namespace

std::vector<Row> bench_motion(const Options& options) {
  std::vector<Row> rows;
  add_bars(options, rows);
  const std::size_t n = options.quick ? 50 : 1000;
  const std::pair<const char*, std::function<MotionCase()>> cases[] = {
      {"octagons, random", [&] { return random_octagons(n); }},
      {"rods, random", [&] { return random_rods(n); }},
      {"gears n=64, random", [&] { return random_outlines("gear", 64, n / 20); }},
      {"coasts n=128, random", [&] { return random_outlines("coast", 128, n / 50); }},
      {"bracket in clutter of 400, random", [&] { return random_clutter(n / 5); }}};
  for (const auto& [name, make] : cases) {
    options.show(rows);
    if (chosen(name, options)) append(rows, run(make(), options));
  }
  options.show(rows);
  append(rows, motion_linkage_rows(options));
  return rows;
}

}  // namespace throng::bench
