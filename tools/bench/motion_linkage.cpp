// SPDX-License-Identifier: MIT
// The cases of throng bench motion that are about robots.
#include "tools/bench/motion_linkage.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "narrowphase/exhaustive.h"
#include "narrowphase/linkage/sampled_linkage.h"
#include "tools/bench/motion_timing.h"
#include "tools/bench/outlines.h"

namespace throng::bench {

namespace {

using namespace narrowphase;

constexpr double kArm = 5.0;         // m, stretched
constexpr double kJointLimit = 2.6;  // rad, of each joint either way

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
    arm[i].shape = &beam, arm[i].lower = -kJointLimit, arm[i].upper = kJointLimit;
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
      to.push_back(std::clamp(from.back() + uniform(place, -step, step), -kJointLimit, kJointLimit));
    }
    if (checker.contact(from)) continue;
    if (free && checker.check_motion(from, to).verdict != Verdict::free) continue;
    c.from.push_back(std::move(from)), c.to.push_back(std::move(to));
  }
}

std::string arm_case_name(std::size_t links, std::size_t obstacles, bool free) {
  return "arm of " + std::to_string(links) + " links, " +
         (obstacles > 0 ? std::to_string(obstacles) + " obstacles, " : "itself alone, ") +
         (free ? "free paths" : "random");
}

std::unique_ptr<ArmCase> arm_case(std::size_t links, std::size_t obstacles, double step, bool free,
                                  std::size_t motions) {
  std::uint64_t place = 0;
  auto c = std::make_unique<ArmCase>();
  c->name = arm_case_name(links, obstacles, free);
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

/// Whether what an answer calls a hit is one: the two parts it names, where it says, by the definition of
/// distance.
bool is_contact(const ArmCase& c, std::size_t i, const LinkageAnswer& hit) {
  std::vector<double> values;
  for (std::size_t k = 0; k < c.arm.size(); ++k)
    values.push_back(c.from[i][k] + hit.to * (c.to[i][k] - c.from[i][k]));
  std::vector<Pose> poses(c.arm.size());
  place_links(c.arm, values, poses);
  const bool post = hit.pair.b == kWorld;
  const Convex& other = post ? c.obstacles[hit.part_b] : c.beam[hit.part_b];
  return exhaustive_separation(c.beam[hit.part_a], poses[hit.pair.a], other,
                               post ? Pose{} : poses[hit.pair.b])
             .distance <= 1e-12 * kArm;
}

struct Asked {
  std::vector<Verdict> verdicts;
  std::vector<bool> proven;  ///< by a contact that `is_contact`
  double evaluations = 0.0;  ///< mean
};

Asked ask_all(const ArmCase& c, const ArmEngine& engine, double seconds) {
  Asked asked;
  std::vector<LinkageAnswer> answers;
  ask_in_turn(c.from.size(), seconds, [&](std::size_t i) { answers.push_back(engine.ask(i)); });
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const LinkageAnswer& answer = answers[i];
    asked.verdicts.push_back(answer.verdict);
    asked.proven.push_back(answer.verdict == Verdict::hit && is_contact(c, i, answer));
    asked.evaluations += static_cast<double>(answer.evaluations) / static_cast<double>(answers.size());
  }
  return asked;
}

/// Which motions hit: in a configuration of many, `step` of the arm apart, or where an engine has proven it.
std::vector<bool> which_hit(const ArmCase& c, const std::vector<Asked>& asked, double step) {
  LinkageChecker checker(c.scene());
  std::vector<bool> hits;
  for (std::size_t i = 0; i < c.from.size(); ++i) {
    const LinkageAnswer sampled = sample_motion(checker, c.from[i], c.to[i], step * kArm);
    hits.push_back(sampled.verdict == Verdict::hit && is_contact(c, i, sampled));
  }
  for (const Asked& one : asked)
    for (std::size_t i = 0; i < one.proven.size(); ++i)
      if (one.proven[i]) hits[i] = true;
  return hits;
}

/// Samples may miss; nobody may tell of a contact that isn't.
Row row(const ArmCase& c, const ArmEngine& engine, const Asked& asked, const std::vector<bool>& hits) {
  int missed = 0, false_hits = 0, undecided = 0;
  for (std::size_t i = 0; i < asked.verdicts.size(); ++i) {
    missed += asked.verdicts[i] == Verdict::free && hits[i];
    false_hits += asked.verdicts[i] == Verdict::hit && !asked.proven[i];
    undecided += asked.verdicts[i] == Verdict::undecided;
  }
  std::string check =
      std::to_string(std::ranges::count(hits, true)) + " of " + std::to_string(c.from.size()) + " hit";
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
  std::vector<Asked> asked;
  std::vector<AskOne> ask;
  for (const ArmEngine& engine : engines) {
    asked.push_back(ask_all(c, engine, asked.empty() ? kAllOfThem : options.quick ? 0.005 : 0.02));
    ask.push_back([&engine](std::size_t i) { return engine.ask(i).from; });
  }
  const std::vector<bool> hits = which_hit(c, asked, options.quick ? 1e-4 : 1e-5);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < engines.size(); ++i) rows.push_back(row(c, engines[i], asked[i], hits));
  expect_agreement(rows);
  time_rows(rows, ask, options.blocks);
  return rows;
}

}  // namespace

std::vector<Row> motion_linkage_rows(const Options& options) {
  std::vector<Row> rows;
  const std::size_t n = options.quick ? 10 : 100;
  const auto add = [&](std::size_t links, std::size_t obstacles, double step, bool free) {
    if (!chosen(arm_case_name(links, obstacles, free), options)) return;
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
