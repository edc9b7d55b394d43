// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/players.h"

#include "tools/bench/peers/chipmunk.h"

namespace throng::bench {

namespace {

// The usual setting first.
constexpr int kSubsteps[] = {4, 1, 16};     // of native
constexpr int kBox2dEffort[] = {4, 1, 16};  // n: 2 n velocity and n - 1 position iterations
constexpr int kIterations[] = {10, 2, 40};  // of Chipmunk
constexpr int kNone[] = {1};

template <Engine engine>
Scene with_substeps(Scene scene, int substeps) {
  scene.engine = engine;
  scene.time.substeps = substeps;
  return scene;
}

Scene as_it_is(Scene scene, int) {
  return scene;
}

std::unique_ptr<Simulation> own(const Scene& scene, int) {
  return simulation(scene);
}

std::unique_ptr<Simulation> chipmunk(const Scene& scene, int iterations) {
  return chipmunk_simulation(scene, iterations);
}

}  // namespace

std::span<const Player> players() {
  static const Player all[] = {
      {"native", false, "substeps", kSubsteps, with_substeps<Engine::native>, own},
      {"event_driven", false, "", kNone, with_substeps<Engine::event_driven>, own},
      {"box2d", true, "effort", kBox2dEffort, with_substeps<Engine::box2d>, own},
      {"chipmunk", true, "iterations", kIterations, as_it_is, chipmunk},
  };
  return all;
}

}  // namespace throng::bench
