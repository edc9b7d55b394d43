// SPDX-License-Identifier: MIT
// throng bench lean: one scene, to which features are added one at a time. What a feature costs is the
// difference to the row above.
#include <iterator>
#include <memory>

#include "scenarios/load.h"
#include "sim/input_error.h"
#include "sim/recording/recorder.h"
#include "sim/simulation.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"
#include "tools/bench/scratch_folder.h"

namespace throng::bench {

namespace {

/// In the order in which they are added.
enum Feature {
  kContacts = 1,
  kFriction,
  kRestitution,
  kGravity,
  kBox,
  kWalls,
  kPolygons,
  kComposites,
  kFast,
  kDriven,
  kSensors,
  kSleep,
  kRecording
};

constexpr const char* kNames[] = {"discs that move",  "+ contacts",    "+ friction",      "+ restitution",
                                  "+ gravity",        "+ a box",       "+ walls",         "+ polygons",
                                  "+ composites",     "+ fast bodies", "+ a driven body", "+ sensors",
                                  "+ leave to sleep", "+ recording"};

/// So many rows of a hundred bodies, from row `first` on.
std::string rows(const std::string& shape, int first, int count) {
  return "[[bodies]]\nshape = '" + shape +
         "'\nvelocity = { maxwell = 0.5 }\nplace.lattice = { origin = [0, " + std::to_string(first) +
         "], spacing = [1, 1], size = [100, " + std::to_string(count) + "] }\n";
}

/// 10,000 discs on a lattice, 4 cm apart, which jostle each other, with all features up to `last`: of a
/// thousand of them each, polygons and composites take the places.
std::string scenario(int last) {
  const auto where = [last](int feature, const std::string& there, const std::string& else_ = "") {
    return feature <= last ? there : else_;
  };
  return "throng = 1\nseed = 4\ntime = { dt = 0.01, until = 100 }\n" +
         where(kContacts, "", "contact.model = 'none'\n") + where(kGravity, "gravity = [0, -9.81]\n") +
         where(kSleep, "", "sleep = false\n") + where(kBox, "domain.box = [[-20, -20], [120, 130]]\n") +
         "materials.default = { friction = " + where(kFriction, "0.5", "0.0") +
         ", restitution = " + where(kRestitution, "0.5", "0.0") +
         " }\n[shapes]\ndisc.disc.radius = 0.48\npaddle.polygon = [[0, 0], [9, 0], [9, 1], [0, 1]]\n"
         "hexagon.polygon = [[0.48, 0], [0.24, 0.41], [-0.24, 0.41], [-0.48, 0], [-0.24, -0.41], "
         "[0.24, -0.41]]\ncapsule.discs = [[-0.2, 0, 0.28], [0.2, 0, 0.28]]\n" +
         rows(where(kPolygons, "hexagon", "disc"), 0, 10) +
         rows(where(kComposites, "capsule", "disc"), 10, 10) + rows("disc", 20, 80) +
         where(kFast,
               "[[bodies]]\nshape = 'disc'\nvelocity = [150, 0]\n"
               "place.lattice = { origin = [-19, 104], spacing = [1, 2], size = [1, 10] }\n") +
         where(kDriven, "[[bodies]]\nshape = 'paddle'\nat = [-5.5, 60]\nspin = 2\nkind = 'kinematic'\n") +
         where(kWalls, "[[walls]]\npolyline = [[-1, 40], [-1, -1], [100, -1], [100, 40]]\n") +
         where(kSensors, "[[sensors]]\nname = 'near'\nof = 'all'\nradius = 2.0\n");
}

/// The scene with features up to one of them, and its run.
struct Lean {
  Lean(int last, const ScratchFolder& folder) {
    Loaded loaded = load_scenario_text(scenario(last), "lean.toml");
    if (loaded.errors() > 0) throw InputError(to_string(loaded.diagnostics, "lean.toml"));
    scene = std::move(loaded.scene);
    simulation = throng::simulation(scene);
    if (last >= kRecording)
      recorder = std::make_unique<Recorder>(folder.path + "/lean.h5", scene, Provenance{}, true);
  }

  void steps(int n) {
    for (int i = 0; i < n; ++i) {
      simulation->step();
      if (recorder) recorder->record(simulation->state());
    }
  }

  Scene scene;
  std::unique_ptr<Simulation> simulation;
  std::unique_ptr<Recorder> recorder;
};

}  // namespace

std::vector<Row> bench_lean(const Options& options) {
  const char* const name = "10,000 bodies";
  if (!chosen(name, options)) return {};
  const int steps = options.quick ? 1 : 5;
  const ScratchFolder folder;
  std::vector<std::unique_ptr<Lean>> scenes;
  std::vector<Contestant> contestants;
  for (int last = 0; last < static_cast<int>(std::size(kNames)); ++last) {
    Lean* const scene = scenes.emplace_back(std::make_unique<Lean>(last, folder)).get();
    scene->steps(steps);
    contestants.push_back({kNames[last], [scene, steps] { scene->steps(steps); }});
  }
  interleave(contestants, options.blocks, steps);
  std::vector<Row> rows;
  double before = 0.0;
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const double ms = median(contestants[i].ms);
    rows.push_back({"lean",
                    name,
                    contestants[i].engine,
                    1,
                    contestants[i].ms,
                    static_cast<double>(steps),
                    "",
                    {{"price_ms", ms - before}, {"contacts", scenes[i]->simulation->contacts()}}});
    before = ms;
  }
  return rows;
}

}  // namespace throng::bench
