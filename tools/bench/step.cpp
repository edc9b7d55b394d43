// SPDX-License-Identifier: MIT
// throng bench step: scenes of bodies at fixed size, engines in turn in steps of 1/60 s at their customary
// settings: native with the substeps that scenarios have which don't say how many, Box2D with 8 and 3
// iterations, Chipmunk with 10. Native settles by itself; the others begin where it was then.
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "sim/observe.h"
#include "sim/simulation.h"
#include "sim/simulation_error.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"
#include "tools/bench/minimal_discs.h"
#include "tools/bench/peers/chipmunk.h"
#include "tools/bench/scenes.h"

namespace throng::bench {

namespace {

const std::vector<std::string> kCustomary = {"time.dt=0.016666666666666666", "time.substeps=7"};
constexpr int kBox2dSubsteps = 4;  // which stand for those iterations
constexpr int kLearns = 6;         // times the calm steps that native runs: its contacts learn what they bear

/// So many discs in a square of that side (m): the gallery's share of the area.
std::vector<std::string> wider_gas(const std::string& count, const std::string& side) {
  const std::string square = "[[0, 0], [" + side + ", " + side + "]]";
  return {"bodies[0].count=" + count, "domain.periodic=" + square, "bodies[0].place.random.within=" + square};
}

/// Ten times the gallery's discs on ten times the width: as deep, which takes as long to settle.
std::vector<std::string> wider_pile() {
  return {"bodies[0].count=100000", "domain.box=[[0, 0], [1000, 140]]",
          "bodies[0].place.random.within=[[0, 0], [1000, 130]]"};
}

struct StepCase {
  const char* name;
  const char* scene;
  std::vector<std::string> overrides;
  double settle_s;  ///< native runs so long before anything is timed, and peers begin where it is then
  int calm;         ///< steps that each engine then runs untimed, to find its own rest
  int steps;        ///< in a block
  bool peers, minimal, sleep = false;
  int substeps = 0;  ///< if not 0, native also with so many: as few as keep overlaps below the best peer's;
                     ///< or, of the widest pile, those that keep the deepest below a twentieth of a radius
};

const std::vector<StepCase>& step_cases() {
  static const std::vector<StepCase> all = {
      {"gas n=1000", "gas", {}, 0.0, 100, 40, true, false},
      {"gas n=10000", "gas", wider_gas("10000", "161.8"), 0.0, 20, 10, true, false},
      {"gas n=100000", "gas", wider_gas("100000", "511.66"), 0.0, 5, 2, true, false},
      {"pile n=10000 falling", "pile", {}, 0.5, 0, 4, true, true},
      {"pile n=10000 landing", "pile", {}, 3.5, 0, 4, true, true},
      {"pile n=10000 settled", "pile", {}, 15.0, 1000, 40, true, true, false, 2},
      {"pile n=100000 settled", "pile", wider_pile(), 15.0, 1000, 10, false, true, false, 8},
      {"pile n=10000 asleep", "pile", {}, 15.0, 600, 40, false, false, true},
      {"polygons n=10000 settled", "polygons", {}, 15.0, 1000, 20, true, false, false, 4},
      {"pyramid base=100", "pyramid", {}, 1.0, 150, 40, true, false, false, 2},
      {"hopper", "hopper", {}, 1.0, 0, 20, true, false},
      {"gears", "gears", {}, 2.0, 0, 20, true, false},
      {"billiard", "billiard", {}, 0.0, 0, 100, true, false},
      {"cradle", "cradle", {}, 0.0, 0, 100, true, false},
      {"mixed", "mixed", {}, 3.0, 0, 20, true, false},
  };
  return all;
}

/// Gives a domain that repeats walls, which peers want, out of reach of who stands across its border.
void wall_in(Scene& scene) {
  const double widest = *std::ranges::max_element(scene.bodies.radius);
  scene.domain.kind = DomainKind::box;
  scene.domain.min.array() -= widest;
  scene.domain.max.array() += widest;
}

Scene scene_of(const StepCase& one, const Options& options) {
  std::vector<std::string> overrides = kCustomary;
  overrides.insert(overrides.end(), one.overrides.begin(), one.overrides.end());
  Scene scene = gallery_scene(options.scenarios, one.scene, overrides);
  scene.sleep = false;
  if (scene.domain.kind == DomainKind::periodic) wall_in(scene);
  return scene;
}

/// Bodies outside of the domain's box.
std::size_t escaped(const Scene& scene, const State& state) {
  if (scene.domain.kind != DomainKind::box) return 0;
  return static_cast<std::size_t>(std::ranges::count_if(state.position, [&](const Vec& p) {
    return (p.array() < scene.domain.min.array()).any() || (p.array() > scene.domain.max.array()).any();
  }));
}

/// What is wrong with an engine's states: overlaps after each block, their mean and the deepest.
class Errors {
 public:
  Errors(const Scene& scene, const State& first)
      : scene_(scene), plan_(plan_for(scene)), first_energy_(energy(first)) {}

  void look(const State& state) {
    const Overlap o = overlap(scene_, state);
    ++looks_;
    mean_ += o.mean;
    max_ = std::max(max_, o.max);
  }

  nlohmann::ordered_json row(const State& last) const {
    nlohmann::ordered_json error = {{"mean_overlap", mean_ / std::max(looks_, 1)},
                                    {"max_overlap", max_},
                                    {"kinetic_energy", kinetic_energy(scene_, last)},
                                    {"escaped", escaped(scene_, last)}};
    if (!last.sleep.island.empty()) error["asleep"] = asleep(last.sleep);
    if (plan_.elastic && !plan_.friction) error["energy_drift"] = energy(last) / first_energy_ - 1.0;
    return error;
  }

 private:
  double energy(const State& state) const {
    return kinetic_energy(scene_, state) + potential_energy(scene_, state);
  }

  const Scene& scene_;
  const Plan plan_;
  const double first_energy_;  // J
  int looks_ = 0;
  double mean_ = 0.0, max_ = 0.0;
};

/// One engine's way through a case.
struct Racer {
  std::string engine;
  std::function<void()> step;
  std::function<State()> state;
  Errors errors;
  int calm;             ///< steps before anything is timed
  std::string gave_up;  ///< why it couldn't go on
};

/// Box2D takes no bodies that are too fast for it: a peer that can't go on leaves the race.
void take_steps(Racer& racer, int steps) {
  if (!racer.gave_up.empty()) return;
  try {
    for (int i = 0; i < steps; ++i) racer.step();
  } catch (const SimulationError& error) {
    if (racer.engine.starts_with("native")) throw;
    racer.gave_up = error.what();
  }
}

std::vector<Row> race_all(const StepCase& one, const Options& options, std::vector<Racer>& racers) {
  std::vector<Contestant> contestants;
  for (Racer& racer : racers) {
    const auto block = [&racer, n = one.steps] { take_steps(racer, n); };
    take_steps(racer, racer.calm);
    contestants.push_back({racer.engine, block, {}, [&racer] { racer.errors.look(racer.state()); }});
  }
  interleave(contestants, options.blocks, one.steps);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < racers.size(); ++i) {
    if (const std::string& why = racers[i].gave_up; !why.empty()) {
      std::cerr << one.name << ", " << racers[i].engine << ": left out: " << why << "\n";
      continue;
    }
    const State state = racers[i].state();
    rows.push_back({"step", one.name, racers[i].engine, 1, contestants[i].ms, static_cast<double>(one.steps),
                    "bodies=" + std::to_string(state.id.size()), racers[i].errors.row(state)});
  }
  return rows;
}

Racer racer_of(const std::string& engine, std::shared_ptr<Simulation> simulation, const Scene& scene,
               int calm) {
  const Errors errors(scene, simulation->state());
  return {engine,
          [simulation] { simulation->step(); },
          [simulation] { return simulation->state(); },
          errors,
          calm,
          {}};
}

std::vector<Row> run(const StepCase& one, const Options& options) {
  const Scene start = scene_of(one, options);
  Scene sleeping_scene = start, other_scene = start, scene = start, box2d_scene = start;
  sleeping_scene.sleep = one.sleep, other_scene.time.substeps = one.substeps;
  const double settle_s = options.quick ? 0.05 * one.settle_s : one.settle_s;
  const int calm = options.quick ? one.calm / 50 : one.calm;
  std::vector<Racer> racers;
  // Each with its substeps from the start on: contacts know what they bear.
  const auto add_native = [&](const std::string& engine, const Scene& own) {
    const std::shared_ptr<Simulation> native = simulation(own);
    settle(*native, own, settle_s);
    racers.push_back(racer_of(engine, native, own, kLearns * calm));
  };
  add_native("native", start);
  if (one.sleep) add_native("native, sleeps", sleeping_scene);
  if (one.substeps > 0) add_native("native, " + std::to_string(one.substeps), other_scene);

  scene = box2d_scene = begun_at(start, racers[0].state());
  box2d_scene.engine = Engine::box2d, box2d_scene.time.substeps = kBox2dSubsteps;
  std::optional<MinimalDiscs> minimal;
  if (one.minimal) {
    minimal.emplace(scene);
    racers.push_back({"minimal",
                      [&] { minimal->step(); },
                      [&] { return minimal->state(); },
                      Errors(scene, minimal->state()),
                      calm,
                      {}});
  }
  if (one.peers) racers.push_back(racer_of("box2d", simulation(box2d_scene), box2d_scene, calm));
  if (auto chipmunk = one.peers ? chipmunk_simulation(scene) : nullptr)
    racers.push_back(racer_of("chipmunk", std::move(chipmunk), scene, calm));
  return race_all(one, options, racers);
}

}  // namespace

std::vector<Row> bench_step(const Options& options) {
  std::vector<Row> rows;
  for (const StepCase& one : step_cases()) {
    if (!chosen(one.name, options)) continue;
    for (Row& row : run(one, options)) rows.push_back(std::move(row));
    options.show(rows);
  }
  return rows;
}

}  // namespace throng::bench
