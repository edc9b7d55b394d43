// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "sim/engine_event_driven.h"
#include "tests/sim/trial.h"

namespace throng {

/// A scene and its run, from collision to collision.
struct Flown {
  explicit Flown(const std::string& text) : Flown(scene_from("engine = \"event_driven\"\n" + text)) {}
  explicit Flown(Scene given) : scene(std::move(given)), simulation(event_driven_simulation(scene)) {}

  void steps(int n) {
    for (int i = 0; i < n; ++i) simulation->step();
  }
  const Vec& at(std::size_t row) const { return simulation->state().position[row]; }
  const Vec& velocity(std::size_t row) const { return simulation->state().velocity[row]; }

  Scene scene;
  std::unique_ptr<Simulation> simulation;
};

inline std::string setting(double restitution, double friction, double dt = 0.1) {
  return "time = { dt = " + std::to_string(dt) + ", until = 1 }\n" + material(restitution, friction) + kDisc;
}

}  // namespace throng
