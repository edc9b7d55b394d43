// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/players.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/auto_time.h"
#include "sim/input_error.h"
#include "tools/bench/peers/chipmunk.h"

namespace throng::bench {

namespace {

// The usual setting first.
constexpr int kSubsteps[] = {4, 1, 16};     // of native
constexpr int kBox2dEffort[] = {4, 1, 16};  // n: 2 n velocity and n - 1 position iterations
constexpr int kIterations[] = {10, 2, 40};  // of Chipmunk
constexpr int kSpringSubsteps[] = {16};
constexpr int kNone[] = {1};
constexpr int kErrors[] = {2, 1, 3};  // n: an error of 10^-n is asked of native, who chooses dt and substeps
constexpr double kPerImpact = 20.0;   // substeps in an impact of spring: the stiffness follows from them

template <Engine engine>
Scene with_substeps(Scene scene, int substeps) {
  scene.engine = engine;
  scene.time.substeps = substeps;
  return scene;
}

double asked(int digits) {
  return std::pow(10.0, -digits);
}

Scene with_chosen_steps(Scene scene, int digits) {
  scene.engine = Engine::native;
  scene.time.error = asked(digits);
  const AutoTime chosen = auto_time(scene);
  if (!chosen.refusal.empty()) throw InputError(chosen.refusal);
  scene.time.dt = chosen.dt, scene.time.substeps = chosen.substeps;
  return scene;
}

/// kg, of two of the lightest bodies that move.
double reduced_mass(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < scene.bodies.size(); ++row)
    if (scene.bodies.kind[row] == BodyKind::dynamic) least = std::min(least, mass(scene, row));
  return 0.5 * least;
}

/// With springs as stiff as the steps bear, where the scene has none of its own.
Scene with_springs(Scene scene, int substeps) {
  scene.engine = Engine::native;
  scene.time.substeps = substeps;
  if (is_soft(scene.contact)) return scene;
  scene.contact = ContactModel::spring;
  const double impact = kPerImpact * scene.time.dt / substeps;  // s
  scene.soft.stiffness = reduced_mass(scene) * std::pow(std::numbers::pi / impact, 2);
  return scene;
}

Scene rigid(Scene scene, int) {
  if (is_soft(scene.contact)) throw InputError("contact.model: bodies are hard here");
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
      {"native auto", false, "for 1e-", kErrors, with_chosen_steps, own, asked},
      {"spring", false, "substeps", kSpringSubsteps, with_springs, own, nullptr, false},
      {"event_driven", false, "", kNone, with_substeps<Engine::event_driven>, own},
      {"box2d", true, "effort", kBox2dEffort, with_substeps<Engine::box2d>, own},
      {"chipmunk", true, "iterations", kIterations, rigid, chipmunk},
  };
  return all;
}

}  // namespace throng::bench
