// SPDX-License-Identifier: MIT
// throng bench recording: a run with every step recorded against the same run without.
#include <stdlib.h>

#include <filesystem>

#include "sim/recording/recorder.h"
#include "sim/simulation.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"
#include "tools/bench/scenes.h"

namespace throng::bench {

namespace {

/// A folder that goes when this does.
struct ScratchFolder {
  std::string path = (std::filesystem::temp_directory_path() / "throng-bench-XXXXXX").string();
  ScratchFolder() { path = mkdtemp(path.data()); }
  ~ScratchFolder() { std::filesystem::remove_all(path); }
};

void run(const Scene& scene, int steps, Recorder* recorder) {
  const auto simulation = throng::simulation(scene);
  for (int i = 0; i < steps; ++i) {
    simulation->step();
    if (recorder) recorder->record(simulation->state());
  }
  if (recorder) recorder->finish();
}

}  // namespace

std::vector<Row> bench_recording(const Options& options) {
  const int steps = options.quick ? 20 : 400;
  const ScratchFolder folder;
  const Scene scene = settled(gallery_scene(options.scenarios, "pile"), options.quick ? 0.5 : 5.0);
  const std::string file = folder.path + "/pile.h5";
  std::vector<Contestant> contestants = {{"unrecorded", [&] { run(scene, steps, nullptr); }},
                                         {"recorded", [&] {
                                            Recorder recorder(file, scene, {}, true);
                                            run(scene, steps, &recorder);
                                          }}};
  interleave(contestants, options.blocks, steps);
  std::vector<Row> rows;
  for (const Contestant& c : contestants)
    rows.push_back(
        {"recording", "pile n=10000 every step", c.engine, 1, c.ms, static_cast<double>(steps), "", {}});
  return rows;
}

}  // namespace throng::bench
