// SPDX-License-Identifier: MIT
// The cases of throng bench motion that are about robots.
#include "tools/bench/motion_linkage.h"

#include <cstdio>
#include <limits>
#include <memory>

#include "narrowphase/linkage/sampled_linkage.h"
#include "tools/bench/interleave.h"
#include "tools/bench/outlines.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

constexpr double kArm = 5.0;                                            // m, stretched
constexpr double kAllOfThem = std::numeric_limits<double>::infinity();  // s, that asking may take

volatile double sink;  // so that no answer is left out

/// An arm, what stands around it, and straight motions from free configurations.
struct ArmCase {
  std::string name;
  std::vector<Convex> beam, obstacles;
  PartsBvh beam_bvh, obstacles_bvh;
  Linkage arm;
  std::vector<LinkPair> pairs;
  std::vector<std::vector<double>> from, to;

  LinkageScene scene() const { return {arm, pairs, obstacles.empty() ? nullptr : &obstacles_bvh}; }
};

double uniform(std::uint64_t& place, double from, double to) {
  return 0.5 * (from + to + (to - from) * noise(77, place++));
}

std::vector<Convex> posts(std::size_t count, std::uint64_t& place) {
  std::vector<Convex> result;
  while (result.size() < count) {
    const Vec at{uniform(place, -10.0, 10.0), uniform(place, -10.0, 10.0)};
    const double radius = uniform(place, 0.02, 0.06);
    if (at.norm() < 0.2) continue;
    std::vector<Vec> corners;
    for (int i = 0; i < 5; ++i)
      corners.push_back(at + narrowphase::pose({0.0, 0.0}, 1.2566 * i + at.x()).rotate({radius, 0.0}));
    result.push_back(convex(std::move(corners)));
  }
  return result;
}

Linkage arm_of(std::size_t links, const PartsBvh& beam) {
  Linkage arm(links);
  for (std::size_t i = 0; i < links; ++i) {
    arm[i].shape = &beam, arm[i].lower = -2.6, arm[i].upper = 2.6;
    if (i > 0)
      arm[i].parent = static_cast<std::uint32_t>(i - 1), arm[i].at = {kArm / static_cast<double>(links), 0.0};
  }
  return arm;
}

/// Motions as planners ask for, each joint by up to `step` rad; only free ones if `free`.
void add_motions(ArmCase& c, std::size_t count, double step, bool free, std::uint64_t& place) {
  LinkageChecker checker(c.scene());
  while (c.from.size() < count) {
    std::vector<double> from, to;
    for (std::size_t i = 0; i < c.arm.size(); ++i) {
      from.push_back(uniform(place, -2.0, 2.0));
      to.push_back(from.back() + uniform(place, -step, step));
    }
    if (checker.contact(from)) continue;
    if (free && checker.check_motion(from, to).verdict != Verdict::free) continue;
    c.from.push_back(std::move(from)), c.to.push_back(std::move(to));
  }
}

std::string case_name(std::size_t links, std::size_t obstacles, bool free) {
  return "arm of " + std::to_string(links) + " links, " +
         (obstacles > 0 ? std::to_string(obstacles) + " obstacles, " : "itself alone, ") +
         (free ? "free paths" : "random");
}

std::unique_ptr<ArmCase> arm_case(std::size_t links, std::size_t obstacles, double step, bool free,
                                  std::size_t motions) {
  std::uint64_t place = 0;
  auto c = std::make_unique<ArmCase>();
  c->name = case_name(links, obstacles, free);
  const double length = kArm / static_cast<double>(links);
  c->beam = {convex({{0.0, -0.02}, {length, -0.02}, {length, 0.02}, {0.0, 0.02}})};
  c->beam_bvh = parts_bvh(c->beam);
  if (obstacles > 0) c->obstacles = posts(obstacles, place), c->obstacles_bvh = parts_bvh(c->obstacles);
  c->arm = arm_of(links, c->beam_bvh);
  c->pairs = pairs_to_check(c->arm, obstacles > 0);
  add_motions(*c, motions, step, free, place);
  return c;
}

struct ArmEngine {
  std::string name;
  bool exact;
  std::function<LinkageAnswer(std::size_t)> ask;
};

std::vector<ArmEngine> arm_engines(const ArmCase& c) {
  const auto checker = std::make_shared<LinkageChecker>(c.scene());
  std::vector<ArmEngine> engines{
      {"bisection", true, [&c, checker](std::size_t i) { return checker->check_motion(c.from[i], c.to[i]); }},
      {"first contact", true,
       [&c, checker](std::size_t i) { return checker->first_contact(c.from[i], c.to[i]); }}};
  for (const double epsilon : {1e-1, 1e-2, 1e-3, 1e-4}) {
    char name[32];
    std::snprintf(name, sizeof name, "sampled %g", epsilon);
    engines.push_back({name, false, [&c, checker, epsilon](std::size_t i) {
                         return sample_motion(*checker, c.from[i], c.to[i], epsilon * kArm);
                       }});
  }
  return engines;
}

struct Asked {
  std::vector<Verdict> verdicts;
  double evaluations = 0.0;  ///< mean
};

Asked ask_all(const ArmCase& c, const ArmEngine& engine, double seconds) {
  const std::chrono::duration<double> affordable(seconds);
  const auto begin = std::chrono::steady_clock::now();
  Asked asked;
  double evaluations = 0.0;
  for (std::size_t i = 0; i < c.from.size(); ++i) {
    const LinkageAnswer answer = engine.ask(i);
    asked.verdicts.push_back(answer.verdict);
    evaluations += static_cast<double>(answer.evaluations);
    if (std::chrono::steady_clock::now() - begin > affordable) break;
  }
  asked.evaluations = evaluations / static_cast<double>(asked.verdicts.size());
  return asked;
}

/// Against the bisection's verdicts, which the first contacts must repeat and samples never contradict.
Row row(const ArmCase& c, const ArmEngine& engine, const Asked& asked, const Asked& truth) {
  int missed = 0, false_hits = 0, undecided = 0, hits = 0;
  for (const Verdict verdict : truth.verdicts) hits += verdict == Verdict::hit;
  for (std::size_t i = 0; i < asked.verdicts.size(); ++i) {
    missed += asked.verdicts[i] == Verdict::free && truth.verdicts[i] == Verdict::hit;
    false_hits += asked.verdicts[i] == Verdict::hit && truth.verdicts[i] == Verdict::free;
    undecided += asked.verdicts[i] == Verdict::undecided;
  }
  std::string check = std::to_string(hits) + " of " + std::to_string(c.from.size()) + " hit";
  if (false_hits > 0 || (engine.exact && missed > 0)) check += ", but " + engine.name + " says otherwise";
  Row result{"motion", c.name, engine.name, 1, {}, static_cast<double>(asked.verdicts.size()), check};
  result.error = {{"evaluations", asked.evaluations},
                  {"missed", missed},
                  {"false_hits", false_hits},
                  {"undecided", undecided}};
  return result;
}

std::vector<Row> run(const ArmCase& c, const Options& options) {
  const std::vector<ArmEngine> engines = arm_engines(c);
  std::vector<Row> rows;
  std::vector<Contestant> contestants;
  Asked truth;
  for (const ArmEngine& engine : engines) {
    const bool first = rows.empty();
    const Asked asked = ask_all(c, engine, first ? kAllOfThem : options.quick ? 0.005 : 0.02);
    if (first) truth = asked;
    rows.push_back(row(c, engine, asked, truth));
    contestants.push_back({engine.name, [&engine, n = asked.verdicts.size()] {
                             double sum = 0.0;
                             for (std::size_t i = 0; i < n; ++i) sum += engine.ask(i).from;
                             sink = sum;
                           }});
  }
  expect_agreement(rows);
  interleave(contestants, options.blocks, 1.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const double ms : contestants[i].ms) rows[i].ms.push_back(ms / rows[i].work);
    rows[i].error["ns"] = 1e6 * median(rows[i].ms);
  }
  return rows;
}

}  // namespace

std::vector<Row> motion_linkage_rows(const Options& options) {
  std::vector<Row> rows;
  const std::size_t n = options.quick ? 10 : 100;
  const auto add = [&](std::size_t links, std::size_t obstacles, double step, bool free) {
    if (!chosen(case_name(links, obstacles, free), options)) return;
    const auto c = arm_case(links, obstacles, step, free, n);
    for (Row& row : run(*c, options)) rows.push_back(std::move(row));
  };
  for (const std::size_t links : {2, 4, 10}) {
    add(links, 1000, 0.3, true);
    add(links, 1000, 0.3, false);
  }
  add(10, 0, 1.0, false);
  return rows;
}

}  // namespace throng::bench
