// SPDX-License-Identifier: MIT
#include "tools/bench/scenes.h"

#include <cstdio>
#include <filesystem>

#include "scenarios/load.h"
#include "sim/input_error.h"
#include "sim/simulation.h"

namespace throng::bench {

Scene gallery_scene(const std::string& folder, const std::string& name,
                    const std::vector<std::string>& overrides) {
  const std::string file = folder + "/" + name + ".toml";
  if (!std::filesystem::exists(file))
    throw InputError(
        "there is no " + file +
        ": benchmarks need the files of their clone; of the gallery --scenarios names the folder");
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

void settle(Simulation& simulation, const Scene& scene, double seconds) {
  if (!(seconds > 0.0)) return;
  std::fprintf(stderr, "settling %s for %g s of its time\n", scene.name.c_str(), seconds);
  while (static_cast<double>(simulation.state().step) * scene.time.dt < seconds) simulation.step();
}

Scene settled(Scene scene, double seconds) {
  const Engine engine = scene.engine;
  scene.engine = Engine::native;
  const auto simulation = throng::simulation(scene);
  settle(*simulation, scene, seconds);
  Scene result = begun_at(scene, simulation->state());
  result.engine = engine;
  return result;
}

namespace {

void add_image(const Bodies& from, std::size_t row, bool mirrored, const Vec& shift, Bodies& to) {
  const double sign = mirrored ? -1.0 : 1.0;
  const auto turned = [sign](const Vec& vector) { return Vec(sign * vector.x(), vector.y()); };
  to.shape.push_back(from.shape[row]), to.material.push_back(from.material[row]);
  to.kind.push_back(from.kind[row]), to.radius.push_back(from.radius[row]);
  to.position.push_back(turned(from.position[row]) + shift);
  to.velocity.push_back(turned(from.velocity[row]));
  to.angle.push_back(sign * from.angle[row]), to.spin.push_back(sign * from.spin[row]);
}

}  // namespace

Scene side_by_side(const Scene& scene, int copies) {
  const double left = scene.domain.min.x(), width = scene.domain.max.x() - left;
  Scene all = scene;
  all.domain.max.x() = left + copies * width;
  all.bodies = {};
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    for (int i = 0; i < copies; ++i) {
      const bool mirrored = i % 2 == 1;
      const double shift = mirrored ? 2.0 * left + (i + 1) * width : i * width;
      add_image(scene.bodies, row, mirrored, Vec(shift, 0.0), all.bodies);
    }
  return all;
}

}  // namespace throng::bench
