// SPDX-License-Identifier: MIT
#include "tools/bench/scenes.h"

#include <cstdio>

#include "scenarios/load.h"
#include "sim/input_error.h"
#include "sim/simulation.h"

namespace throng::bench {

Scene gallery_scene(const std::string& folder, const std::string& name,
                    const std::vector<std::string>& overrides) {
  const std::string file = folder + "/" + name + ".toml";
  Loaded loaded = load_scenario(file, overrides);
  if (loaded.errors() > 0) throw InputError(to_string(loaded.diagnostics, file));
  return std::move(loaded.scene);
}

Scene begun_at(Scene scene, const State& state) {
  scene.bodies.position = state.position;
  scene.bodies.angle = state.angle;
  scene.bodies.velocity = state.velocity;
  scene.bodies.spin = state.spin;
  return scene;
}

Scene settled(Scene scene, double seconds) {
  std::fprintf(stderr, "settling %s for %g s of its time\n", scene.name.c_str(), seconds);
  const Engine engine = scene.engine;
  scene.engine = Engine::native;
  const auto simulation = throng::simulation(scene);
  while (static_cast<double>(simulation->state().step) * scene.time.dt < seconds) simulation->step();
  Scene result = begun_at(scene, simulation->state());
  result.engine = engine;
  return result;
}

}  // namespace throng::bench
