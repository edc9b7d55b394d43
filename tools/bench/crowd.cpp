// SPDX-License-Identifier: MIT
// throng bench crowd: whole steps of crowds on an open floor, beside their plain twins and on two threads.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "scenarios/load.h"
#include "sim/simulation.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"
#include "tools/bench/plain_crowd.h"

namespace throng::bench {

namespace {

constexpr double kAgreement = 1e-9;  // m, after a step from one state
constexpr std::size_t kMostForTwins = 10'000;
constexpr int kWarm = 20;  // steps, until nobody starts any more

int steps_a_block(std::size_t agents) {
  return std::max<int>(1, static_cast<int>(100'000 / agents));
}

/// Steps that every contestant walks at most: in blocks, of which one more isn't counted.
int steps_in_all(std::size_t agents, int blocks) {
  return 1 + kWarm + (blocks + 2) * steps_a_block(agents);
}

struct CrowdCase {
  const char* model;
  std::size_t agents;
  double each;  ///< m², of the floor
  double radius, speed, dt;
  const char* parameters;

  std::string name() const { return std::string(model) + " n=" + std::to_string(agents); }
};

/// Of 24 neighbours within 3 m; of orca RVO2's circle: radius 1.5 m, the 10 nearest of about 20 within 15 m.
std::vector<CrowdCase> crowd_cases(bool quick) {
  std::vector<CrowdCase> all;
  for (std::size_t agents : {10'000, 100'000, 1'000'000})
    for (const char* model : {"collision_free_speed", "social_force", "orca"}) {
      if (quick && agents > 10'000) continue;
      const bool orca = std::string(model) == "orca";
      all.push_back({model, quick ? agents / 10 : agents, orca ? 35.0 : 1.178, orca ? 1.5 : 0.2,
                     orca ? 1.5 : 1.34, orca ? 0.1 : 0.02,
                     orca ? "orca = { horizon = 10, wall_horizon = 1, cutoff = 15 }" : ""});
    }
  return all;
}

/// Two streams that cross: to the right, and upwards, to goals that nobody reaches in so many steps.
Scene scene_of(const CrowdCase& one, int steps) {
  const double crowded = std::sqrt(one.each * static_cast<double>(one.agents));
  const double inside = crowded + steps * one.dt * 2.0 * one.speed, side = inside + 2.0;
  const auto number = [](double value) { return std::to_string(value); };
  const std::string s = number(side), inner = number(inside), from = number(crowded);
  const std::string half = std::to_string(one.agents / 2);
  std::string text = "throng = 1\nname = 'crowd'\nseed = 4\ntime = { dt = " + number(one.dt) +
                     ", until = 1e6 }\ndomain.box = [[0, 0], [" + s + ", " + s + "]]\n[areas]\nright = [[" +
                     inner + ", 0], [" + s + ", 0], [" + s + ", " + s + "], [" + inner + ", " + s +
                     "]]\nabove = [[0, " + inner + "], [" + s + ", " + inner + "], [" + s + ", " + s +
                     "], [0, " + s + "]]\n";
  for (const char* goal : {"right", "above"})
    text += "[[agents]]\ncount = " + half + "\nplace = { random = { within = [[0, 0], [" + from + ", " +
            from + "]] } }\nradius = " + number(one.radius) + "\ndesired_speed = " + number(one.speed) +
            "\ngoal = '" + goal + "'\nmodel = '" + one.model + "'\n" + one.parameters + "\n";
  Loaded loaded = load_scenario_text(text, "crowd");
  if (loaded.errors() > 0) throw std::runtime_error(to_string(loaded.diagnostics, "crowd"));
  return std::move(loaded.scene);
}

/// m, the farthest that two states are apart by one step from the same.
double disagreement(const Scene& scene) {
  const auto native = simulation(scene);
  PlainCrowd plain(scene);
  native->step(), plain.step();
  const State& state = native->state();
  double most = 0.0;
  for (std::size_t row = 0; row < state.id.size(); ++row)
    most = std::max(most, (state.position[row] - plain.position()[state.id[row] - 1]).norm());
  return most;
}

/// Expects that all have gone the same number of steps.
void expect_same(const std::string& name, const Simulation& a, const Simulation& b) {
  if (hash(a.state()) != hash(b.state()))
    throw std::runtime_error(name + ": two threads have come to another state than one");
}

std::vector<Row> run(const CrowdCase& one, const Options& options) {
  std::fprintf(stderr, "placing %zu agents\n", one.agents);
  const Scene scene = scene_of(one, steps_in_all(one.agents, options.blocks));
  const auto native = simulation(scene), shared = simulation(scene, 2);
  std::optional<PlainCrowd> plain;
  if (one.agents <= kMostForTwins) {
    plain.emplace(scene);
    const double apart = disagreement(scene);
    if (!(apart <= kAgreement))
      throw std::runtime_error(one.name() + ": the plain twin is " + std::to_string(apart) +
                               " m off after a step");
  }
  const int steps = steps_a_block(one.agents);
  const auto block = [steps](auto& walks) {
    return [steps, &walks] {
      for (int i = 0; i < steps; ++i) walks.step();
    };
  };
  std::vector<Contestant> contestants{{"throng", block(*native)}, {"two threads", block(*shared)}};
  if (plain) contestants.push_back({"plain", block(*plain)});
  for (Contestant& contestant : contestants)
    for (int i = 0; i < kWarm; i += steps) contestant.block();
  interleave(contestants, options.blocks, steps);
  expect_same(one.name(), *native, *shared);
  if (native->state().id.size() != one.agents) throw std::runtime_error(one.name() + ": agents have left");
  std::vector<Row> rows;
  for (const Contestant& contestant : contestants)
    rows.push_back({"crowd",
                    one.name(),
                    contestant.engine,
                    contestant.engine == "two threads" ? 2 : 1,
                    contestant.ms,
                    static_cast<double>(steps),
                    "agents=" + std::to_string(one.agents),
                    {{"us_per_agent_step", 1e3 * median(contestant.ms) / static_cast<double>(one.agents)}}});
  return rows;
}

}  // namespace

std::vector<Row> bench_crowd(const Options& options) {
  std::vector<Row> rows = bench_ways(options);
  options.show(rows);
  for (Row& row : bench_stadium(options)) rows.push_back(std::move(row));
  options.show(rows);
  for (const CrowdCase& one : crowd_cases(options.quick)) {
    if (!chosen(one.name(), options)) continue;
    for (Row& row : run(one, options)) rows.push_back(std::move(row));
    options.show(rows);
  }
  return rows;
}

}  // namespace throng::bench
