// SPDX-License-Identifier: MIT
// throng bench step: the gallery's scenes at fixed size, each engine in turn from the same state.
#include <cstdio>
#include <memory>
#include <optional>

#include "sim/observe.h"
#include "sim/simulation.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"
#include "tools/bench/minimal_discs.h"
#include "tools/bench/scenes.h"

namespace throng::bench {

namespace {

struct Case {
  const char* name;
  const char* scene;
  std::vector<std::string> overrides;
  double settle_s;  ///< native runs so long before anything is timed
  int calm;         ///< steps that each engine then runs untimed, to find its own rest
  int steps;        ///< in a block
  bool box2d, minimal;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"gas n=1000", "gas", {}, 0.0, 100, 40, false, false},
      {"pile n=10000 falling", "pile", {}, 0.5, 0, 4, true, true},
      {"pile n=10000 settled", "pile", {}, 15.0, 150, 4, true, true},
      {"polygons n=10000 settled", "polygons", {}, 15.0, 150, 2, true, false},
      {"pyramid base=100", "pyramid", {}, 1.0, 50, 4, true, false},
      {"hopper", "hopper", {}, 1.0, 0, 20, true, false},
      {"gears", "gears", {}, 2.0, 0, 20, true, false},
      {"billiard", "billiard", {}, 0.0, 0, 100, true, false},
      {"cradle", "cradle", {}, 0.0, 0, 100, true, false},
      {"mixed", "mixed", {}, 3.0, 0, 20, true, false},
  };
  return all;
}

nlohmann::ordered_json errors(const Scene& scene, const State& state) {
  const Overlap o = overlap(scene, state);
  return {{"mean_overlap", o.mean}, {"max_overlap", o.max}, {"kinetic_energy", kinetic_energy(scene, state)}};
}

/// Bodies that left the domain's box: none may.
std::string check(const Scene& scene, const State& state) {
  std::size_t escaped = 0;
  if (scene.domain.kind == DomainKind::box)
    for (const Vec& p : state.position)
      escaped += (p.array() < scene.domain.min.array()).any() || (p.array() > scene.domain.max.array()).any();
  return "bodies=" + std::to_string(state.id.size()) + " escaped=" + std::to_string(escaped);
}

std::vector<Row> run(const Case& one, const Options& options) {
  Scene scene = gallery_scene(options.scenarios, one.scene, one.overrides);
  scene.sleep = false;
  const double settle = options.quick ? 0.1 * one.settle_s : one.settle_s;
  if (settle > 0.0) scene = settled(scene, settle);
  Scene box2d_scene = scene;
  box2d_scene.engine = Engine::box2d;

  const auto native = simulation(scene);
  const auto box2d = one.box2d ? simulation(box2d_scene) : nullptr;
  std::optional<MinimalDiscs> minimal;
  if (one.minimal) minimal.emplace(scene);
  std::vector<Contestant> contestants;
  const auto add = [&](const char* engine, auto step) {
    contestants.push_back({engine, [step, n = one.steps] {
                             for (int i = 0; i < n; ++i) step();
                           }});
  };
  add("native", [&] { native->step(); });
  if (minimal) add("minimal", [&] { minimal->step(); });
  if (box2d) add("box2d", [&] { box2d->step(); });
  for (Contestant& c : contestants)
    for (int i = 0; i < one.calm / one.steps; ++i) c.block();
  interleave(contestants, options.blocks, one.steps);

  std::vector<Row> rows;
  for (const Contestant& c : contestants) {
    const State& state = c.engine == "native"  ? native->state()
                         : c.engine == "box2d" ? box2d->state()
                                               : minimal->state();
    rows.push_back({"step", one.name, c.engine, 1, c.ms, static_cast<double>(one.steps), check(scene, state),
                    errors(scene, state)});
  }
  return rows;
}

}  // namespace

std::vector<Row> bench_step(const Options& options) {
  std::vector<Row> rows;
  for (const Case& one : cases()) {
    if (!chosen(one.name, options)) continue;
    for (Row& row : run(one, options)) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace throng::bench
