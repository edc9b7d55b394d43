// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "scenarios/load.h"
#include "sim/recording/recorder.h"
#include "sim/simulation.h"
#include "tests/sim/recording/scenes.h"

/// A recording of agents, with all that may be recorded of them.
namespace throng::testing_recordings {

/// Four who walk to the right: 4 leaves at 0.2 s, 3 passes the door at 0.4 s, 2 enters the hall at 0.6 s.
inline constexpr const char* kMeasuredCrowd = R"toml(throng = 1
name = "measured"
time = { dt = 0.05, until = 1.0 }
record = { every = 2, observables = 2, fields = ["position", "contacts"] }
walkable = "POLYGON ((0 0, 10 0, 10 2, 0 2, 0 0))"
areas = { exit = [[9, 0], [10, 0], [10, 2], [9, 2]], hall = [[5, 0], [8, 0], [8, 2], [5, 2]] }
queues = { till = { line = [[6, 1], [4, 1]], service = 1.0 } }
agents = [
  { at = [1, 0.5], model = "constant_velocity", desired_speed = 1.0, goal = "exit" },
  { at = [4.4, 1.5], model = "constant_velocity", desired_speed = 1.0, goal = "exit" },
  { at = [7.6, 0.5], model = "constant_velocity", desired_speed = 1.0, goal = "exit" },
  { at = [8.8, 1.5], model = "constant_velocity", desired_speed = 1.0, goal = "exit" },
]
measure = [
  { name = "door N/S", line = [[8, 0], [8, 2]] },
  { name = "50 % of it, or %41", area = "hall" },
]
sensors = [{ name = "ears", radius = 3.6, every = 3, record = true }]
)toml";

inline Scene measured_crowd() {
  Loaded loaded = load_scenario_text(kMeasuredCrowd, "measured.toml");
  if (loaded.errors() > 0) throw std::logic_error(to_string(loaded.diagnostics, "measured.toml"));
  return std::move(loaded.scene);
}

/// A recording of what runs to the scene's end.
inline void record_simulation(const std::string& path, const Scene& scene) {
  Recorder recorder(path, scene, provenance());
  const std::unique_ptr<Simulation> run = simulation(scene);
  for (;; run->step()) {
    if (is_frame(scene.record, run->state().step)) recorder.record(run->state(), {}, run->sensed());
    if (run->state().step == scene.time.steps()) break;
  }
  recorder.finish(run->state().crowd);
}

}  // namespace throng::testing_recordings
