// SPDX-License-Identifier: MIT
// throng-bench: the benchmarks, apart from the program so that it alone links the peers' libraries.
#include <hwy/targets.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <set>
#include <span>

#include "sim/input_error.h"
#include "tools/bench/benchmarks.h"

namespace {

constexpr const char* kColumns = R"(
Columns: case and engine; ms and ms_min, the median and the least of --blocks figures, each for all the work of the
case; ratio, that median over the one of the case's first engine; then the errors, each as its name and number.
Of soft: us_per_disc_and_substep, of ms_min; contacts_per_disc, how many touch each disc; note, why LAMMPS, the program lmp,
doesn't play.
Of lean: price_ms, the difference of the medians to the row above; contacts, that press at the end.
Of accuracy: ms and the least of them per simulated second; the error, mostly the root mean square distance to the exact
solution at equal times in units of the body's radius; how many times as fast native is at its cheapest setting with at
most that error. In JSON also error_end, of the last of these times, native_ms, and the observed order.
Of stability: energy, how much it grew at most, as a part of what the scene has to lose (where nothing rubs nor damps: how
much it changed); overlap, the deepest at the end, in radii; speed, the root mean square at the end, over sqrt(g size), of
the gas over what each component has at first; moved, how far a box of the stack is off its place at most, in sides.
Of motion, where a query is a pair in motion, a figure is for one query, and the errors are
  evaluations      distances computed, or bounds of them, a query (mean)
  missed           queries that hit and were called free
  false_hits       queries that are free and were called a hit
  undecided        queries that were neither
  time             how far the worst time of a first contact is off, the whole motion being 1
  gap              how far apart, or deep in each other, the two are at the worst of these times, of their size
  growth           k, where evaluations have grown as (1 / clearance)^k since the clearance before
  of ENGINE        the bisection's evaluations over those of that engine, the median of the queries that hit
  ns               the median time of a query
  asked, first_ns  the share of queries that a slow engine was asked, and the first engine's time of a query on
                   these alone, which ratio is to)";

constexpr int kAccuracyBlocks = 5;  // so that all of it takes a quarter of an hour

void refuse_what_does_nothing(const std::string& name, const throng::bench::Options& options) {
  if (name != "broadphase" && name != "recording" && options.large)
    throw throng::InputError(name + ": --large is for broadphase and recording");
  const bool has_engines = name == "broadphase" || name == "validation" || name == "accuracy";
  if (!has_engines && !options.engines.empty())
    throw throng::InputError(name + ": --engine is for broadphase, validation and accuracy");
  if (name != "validation" && !options.set.empty())
    throw throng::InputError(name + ": --set is for validation");
}

/// The sets of instructions that this machine has and that the vectors' kernels are compiled for.
std::map<std::string, std::int64_t> targets() {
  std::map<std::string, std::int64_t> result;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    result[hwy::TargetName(target)] = target;
  return result;
}

/// While it lives, what is printed goes to the standard error: Chipmunk as Debian builds it tells of itself.
class OutputAside {
 public:
  OutputAside() : own_(dup(STDOUT_FILENO)) { dup2(STDERR_FILENO, STDOUT_FILENO); }
  ~OutputAside() {
    std::fflush(stdout);
    dup2(own_, STDOUT_FILENO);
    close(own_);
  }
  OutputAside(const OutputAside&) = delete;
  OutputAside& operator=(const OutputAside&) = delete;

  /// What `print` prints goes where it belongs.
  template <class Print>
  void lift(Print print) {
    std::fflush(stdout);
    dup2(own_, STDOUT_FILENO);
    print();
    std::fflush(stdout);
    dup2(STDERR_FILENO, STDOUT_FILENO);
  }

 private:
  int own_;
};

/// Names are told up to kMost: a benchmark may have hundreds.
std::string why_none(const throng::bench::Options& options) {
  constexpr std::size_t kMost = 40;
  if (*options.any_chosen && !options.engines.empty())
    return "--engine names none that plays: " + options.engines.front();
  const std::set<std::string> names(options.passed_over->begin(), options.passed_over->end());
  if (names.empty()) return "no case is left for these options";
  std::string result = "--only holds for no case's name; there are";
  std::size_t told = 0;
  for (const std::string& name : names)
    if (++told <= kMost) result += "\n  " + name;
  return told <= kMost ? result : result + "\n  and " + std::to_string(told - kMost) + " more";
}

void print(const std::string& name, const std::vector<throng::bench::Row>& rows, std::size_t begin) {
  if (name == "validation") return throng::bench::print_verdicts(rows, begin);
  if (name == "accuracy") return throng::bench::print_accuracy(rows, begin);
  if (name == "stability") return throng::bench::print_stability(rows, begin);
  throng::bench::print_table(rows, begin);
}

void print_end(const std::string& name, const std::vector<throng::bench::Row>& rows) {
  if (name == "accuracy") throng::bench::print_orders(rows);
  if (name == "stability") throng::bench::print_stable(rows);
}

/// Runs the benchmark, and shows each of its rows as soon as it is there: in the table, unless that would
/// stand among JSON, and in `json`.
void run(const std::string& name, std::vector<throng::bench::Row> (*benchmark)(const throng::bench::Options&),
         throng::bench::Options options, bool table, throng::bench::JsonRows& json) {
  using throng::bench::Row;
  OutputAside aside;
  std::size_t shown = 0;
  options.show = [&](const std::vector<Row>& rows) {
    expect_agreement(rows);
    aside.lift([&] {
      if (table && shown < rows.size()) print(name, rows, shown);
      json.add(std::span(rows).subspan(shown));
    });
    shown = rows.size();
  };
  const std::vector<Row> rows = benchmark(options);
  if (rows.empty()) throw throng::InputError(name + ": " + why_none(options));
  options.show(rows);
  aside.lift([&] {
    if (table) print_end(name, rows);
    json.end();
  });
}

}  // namespace

int main(int argc, char** argv) {
  using namespace throng::bench;
  const std::map<std::string, std::vector<Row> (*)(const Options&)> benchmarks = {
      {"step", bench_step},
      {"soft", bench_soft},
      {"lean", bench_lean},
      {"recording", bench_recording},
      {"broadphase", bench_broadphase},
      {"narrowphase", bench_narrowphase},
      {"bvh", bench_bvh},
      {"motion", bench_motion},
      {"crowd", bench_crowd},
      {"validation", bench_validation},
      {"accuracy", bench_accuracy},
      {"knobs", bench_knobs},
      {"stability", bench_stability}};
  Options options;
  std::string name, json, target;
  CLI::App app{"The benchmarks of throng: time and error beside each other, engines in turn in one run."};
  app.name("throng bench");
  app.add_option(
         "NAME", name,
         "step, soft, lean, recording, broadphase, narrowphase, bvh, motion, crowd, validation, accuracy, "
         "knobs or stability")
      ->required()
      ->check(CLI::IsMember(benchmarks));
  app.add_option("--scenarios", options.scenarios, "folder of the gallery")
      ->default_val(of_clone("scenarios"));
  app.add_option("--only", options.only,
                 "cases whose names hold a match of this regular expression; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--engine", options.engines,
                 "broadphase, validation, accuracy: this engine or model alone; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--set", options.set,
                 "validation: a field of all agents, such as social_force.mass=70; may be repeated")
      ->allow_extra_args(false);
  const CLI::Option* blocks =
      app.add_option("--blocks", options.blocks, "figures a row; where it isn't given 5 of accuracy")
          ->check(CLI::Range(1, 1000))
          ->capture_default_str();
  app.add_flag("--quick", options.quick, "short settling and small clouds, to see that all of it runs");
  app.add_flag("--large", options.large,
               "broadphase: ten million points too; recording: seeks in a file of 10 GB, in the folder of "
               "temporary files");
  app.add_option("--target", target,
                 "vectors of this set of instructions alone, instead of this machine's widest")
      ->transform(CLI::IsMember(targets(), CLI::ignore_case));
  app.add_option(
      "--json", json,
      "also writes the rows to this file, a line each, as they are there; -: to the standard output, "
      "and no table");
  app.footer(
      "Examples: throng bench step --only pile --json step.json\n"
      "          throng bench broadphase --only '^uniform n=100000 k=10 random$'  (this case alone)\n" +
      std::string(kColumns));
  try {
    app.parse(argc, argv);
    refuse_what_does_nothing(name, options);
    if (name == "accuracy" && blocks->empty()) options.blocks = kAccuracyBlocks;
    if (!target.empty()) hwy::SetSupportedTargetsForTest(targets().at(target));
    JsonRows rows(json);
    run(name, benchmarks.at(name), options, json != "-", rows);
  } catch (const CLI::Success& answer) {  // --help
    return app.exit(answer);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "throng bench: %s; see throng bench --help\n", error.what());
    return 2;
  } catch (const throng::InputError& error) {
    std::fprintf(stderr, "throng bench: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "throng bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
