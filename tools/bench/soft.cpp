// SPDX-License-Identifier: MIT
// throng bench soft: a settled bed of discs on springs and dashpots, as granular physics has it.
#include <cmath>
#include <memory>

#include "sim/input_error.h"
#include "sim/simulation.h"
#include "sim/soft_timing.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"
#include "tools/bench/scenes.h"

namespace throng::bench {

namespace {

constexpr double kDt = 5e-3;         // s, from one search for pairs to the next
constexpr double kPerImpact = 50.0;  // substeps
constexpr double kSettle = 12.0;     // s, rigidly: springs would take days
constexpr double kRing = 1.5;        // s, softly: until those that were rigid have found their springs

struct Bed {
  const char* name;
  std::vector<std::string> overrides;  // of the gallery's pile
};

const std::vector<Bed>& beds() {
  static const std::vector<Bed> all = {
      {"bed n=10000", {}},
      {"bed n=100000",
       {"bodies[0].count=100000", "domain.box=[[0, 0], [1000, 140]]",
        "bodies[0].place.random.within=[[0, 0], [1000, 130]]"}},
  };
  return all;
}

/// The bed on springs: `contact` is how stiff.
Scene softened(Scene scene, ContactModel model) {
  scene.contact = model;
  scene.soft.stiffness = 1e5;
  scene.soft.youngs_modulus = 1e7;
  scene.time.dt = kDt;
  scene.time.substeps = static_cast<int>(std::ceil(kDt * kPerImpact / soft_timing(scene).contact));
  if (const std::string refusal = soft_refusal(scene); !refusal.empty()) throw InputError("bed: " + refusal);
  return scene;
}

struct Runner {
  Runner(const Scene& bed, ContactModel model) : scene(softened(bed, model)), run(simulation(scene)) {}

  Scene scene;
  std::unique_ptr<Simulation> run;
};

}  // namespace

std::vector<Row> bench_soft(const Options& options) {
  std::vector<Row> rows;
  for (const Bed& bed : beds()) {
    if (!chosen(bed.name, options)) continue;
    const double part = options.quick ? 0.05 : 1.0;
    const Scene settled_bed =
        settled(gallery_scene(options.scenarios, "pile", bed.overrides), part * kSettle);
    std::vector<std::unique_ptr<Runner>> runners;
    std::vector<Contestant> contestants;
    for (const auto& [engine, model] :
         {std::pair("spring", ContactModel::spring), std::pair("hertz", ContactModel::hertz)}) {
      Runner* const runner = runners.emplace_back(std::make_unique<Runner>(settled_bed, model)).get();
      for (int i = 0; i < part * kRing / kDt; ++i) runner->run->step();
      contestants.push_back({engine, [runner] { runner->run->step(); }});
    }
    interleave(contestants, options.blocks, 1);
    for (std::size_t i = 0; i < runners.size(); ++i) {
      const Runner& runner = *runners[i];
      const double discs = static_cast<double>(runner.scene.bodies.size());
      const double substeps = runner.scene.time.substeps;
      rows.push_back({"soft",
                      bed.name,
                      contestants[i].engine,
                      1,
                      contestants[i].ms,
                      substeps,
                      "",
                      {{"us_per_disc_and_substep", 1e3 * minimum(contestants[i].ms) / (discs * substeps)},
                       {"contacts_per_disc", static_cast<double>(runner.run->contacts()) / discs}}});
    }
  }
  return rows;
}

}  // namespace throng::bench
