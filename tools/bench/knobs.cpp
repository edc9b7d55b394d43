// SPDX-License-Identifier: MIT
// throng bench knobs: what beside dt and substeps may be chosen, what it costs and what it changes. All of it
// but sleep must give the same bits. There is no build in single precision, and no margin of neighbour lists
// to choose: it follows from speeds, and a step in which somebody gets beyond it is taken again.
#include <hwy/targets.h>

#include <memory>

#include "sim/observe.h"
#include "sim/simulation.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"
#include "tools/bench/scenes.h"

namespace throng::bench {

namespace {

struct KnobScene {
  const char* name;
  const char* scene;
  std::vector<std::string> overrides;
  double settle_s;
  int steps;  // in a block
};

const std::vector<KnobScene>& scenes() {
  static const std::vector<KnobScene> all = {
      {"pile, settled", "pile", {}, 15.0, 10},
      {"polygons, settled", "polygons", {}, 10.0, 4},
      {"gas",
       "gas",
       {"bodies[0].count=10000", "domain.periodic=[[0, 0], [161.8, 161.8]]",
        "bodies[0].place.random.within=[[0, 0], [161.8, 161.8]]"},
       0.0,
       20}};
  return all;
}

/// A way to play a scene.
struct Setting {
  std::string name;
  std::int64_t target = 0;  // of the vectors; 0: the widest
  int threads = 1;
  bool sleep = false;
};

std::vector<Setting> settings() {
  std::vector<Setting> all{{"as it is"}};
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    all.push_back({std::string("vectors ") + hwy::TargetName(target), target});
  all.push_back({"2 threads", 0, 2});
  return all;
}

struct Played {
  Played(Scene given, const Setting& setting)
      : scene(std::move(given)), target(setting.target), run(simulation(scene, setting.threads)) {}

  void steps(int n) {
    if (target != 0) hwy::SetSupportedTargetsForTest(target);
    for (int i = 0; i < n; ++i) run->step();
    if (target != 0) hwy::SetSupportedTargetsForTest(0);
  }

  Scene scene;
  std::int64_t target;
  std::unique_ptr<Simulation> run;
};

std::vector<Row> play(const std::string& name, const Scene& scene, const std::vector<Setting>& settings,
                      const Options& options, int steps, int calm) {
  std::vector<std::unique_ptr<Played>> played;
  std::vector<Contestant> contestants;
  for (const Setting& setting : settings) {
    Scene own = scene;
    own.sleep = setting.sleep;
    Played* const one = played.emplace_back(std::make_unique<Played>(std::move(own), setting)).get();
    one->steps(calm);
    contestants.push_back({setting.name, [one, steps] { one->steps(steps); }});
  }
  interleave(contestants, options.blocks, steps);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < played.size(); ++i) {
    const State& state = played[i]->run->state();
    const std::string bits = settings[i].sleep ? "" : std::to_string(hash(state));
    rows.push_back(
        {"knobs",
         name,
         settings[i].name,
         settings[i].threads,
         contestants[i].ms,
         double(steps),
         bits,
         {{"mean_overlap", overlap(scene, state).mean}, {"kinetic_energy", kinetic_energy(scene, state)}}});
    if (settings[i].sleep) rows.back().error["asleep"] = asleep(state.sleep);
  }
  return rows;
}

}  // namespace

std::vector<Row> bench_knobs(const Options& options) {
  std::vector<Row> rows;
  for (const KnobScene& one : scenes()) {
    if (!chosen(one.name, options)) continue;
    Scene scene = gallery_scene(options.scenarios, one.scene, one.overrides);
    if (one.settle_s > 0.0) scene = settled(scene, options.quick ? 0.02 * one.settle_s : one.settle_s);
    const int steps = options.quick ? 1 : one.steps;
    for (Row& row : play(one.name, scene, settings(), options, steps, 0)) rows.push_back(std::move(row));
    if (scene.gravity == Vec(0.0, 0.0)) continue;
    const Setting asleep{"sleeps", 0, 1, true};
    const int calm = options.quick ? 1 : 3000;  // steps, until all of it sleeps
    for (Row& row :
         play(one.name + std::string(", at rest"), scene, {{"as it is"}, asleep}, options, steps, calm)) {
      row.check = "";
      rows.push_back(std::move(row));
    }
    options.show(rows);
  }
  return rows;
}

}  // namespace throng::bench
