// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "sim/observe.h"
#include "sim/step.h"
#include "tests/sim/scene_from.h"

namespace throng {

/// A scene and its run.
struct Trial {
  explicit Trial(const std::string& text) : Trial(scene_from(text)) {}
  explicit Trial(Scene given, int threads = 1)
      : scene(std::move(given)),
        plan(plan_for(scene)),
        state(initial_state(scene)),
        work(scene, plan, threads) {}

  void steps(int n) {
    for (int i = 0; i < n; ++i) step(scene, plan, state, work);
  }
  double energy() const { return kinetic_energy(scene, state) + potential_energy(scene, state); }

  Scene scene;
  Plan plan;
  State state;
  Workspace work;
};

inline constexpr double kG = 9.81;  // m/s^2

inline const char* const kDisc = "[shapes]\nball = { disc = { radius = 0.5 } }\n";

inline std::string material(double restitution, double friction) {
  return "[materials.default]\nrestitution = " + std::to_string(restitution) +
         "\nfriction = " + std::to_string(friction) + "\n";
}

inline std::string spring(double stiffness, const std::string& more = "") {
  return "contact = { model = \"spring\", stiffness = " + std::to_string(stiffness) + more + " }\n";
}

inline std::string ball(double x, double y, double vx, double vy, double spin = 0.0) {
  return "[[bodies]]\nshape = \"ball\"\nat = [" + std::to_string(x) + ", " + std::to_string(y) +
         "]\nvelocity = [" + std::to_string(vx) + ", " + std::to_string(vy) +
         "]\nspin = " + std::to_string(spin) + "\n";
}

}  // namespace throng
