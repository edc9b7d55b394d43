// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scenarios/load.h"

/// Small scenarios for the tests of their floor.
namespace throng::testing {

/// Everything that a scenario can say, once.
inline const std::string kEverything = R"toml(throng = 1
name = "everything"
description = "All fields of the grammar"
seed = 7
engine = "native"
gravity = [0.0, -9.81]
sleep = false
time = { dt = 0.01, until = 2.0, substeps = 4 }
domain = { box = [[0, 0], [20, 20]] }
contact = { model = "impulse" }
record = { every = 2, fields = ["position", "spin"], precision = "single" }
[materials.ice]
density = 900
restitution = 0.1
friction = 0.02
rolling_resistance = 0.01
[shapes]
ball = { disc = { radius = 0.4 } }
grain = { disc = { radius = { uniform = [0.1, 0.2] } } }
brick = { polygon = [[0, 0], [1, 0], [1, 1], [0, 1]] }
robot = { discs = [[0, 0, 0.3], [0.4, 0, 0.2]] }
[[bodies]]
shape = "ball"
at = [2, 3]
count = 1
angle = 0.5
velocity = [1, -1]
spin = 0.25
material = "ice"
kind = "kinematic"
[[bodies]]
shape = "grain"
count = 20
place = { random = { within = [[10, 10], [19, 19]], gap = 0.01 } }
angle = { uniform = [-1, 1] }
velocity = { maxwell = 0.5 }
[[bodies]]
shape = "brick"
place = { lattice = { origin = [5, 5], spacing = [1.5, 2], size = [2, 2] } }
[[bodies]]
shape = "robot"
at = [15, 5]
[[walls]]
segment = [[0, 1], [5, 1]]
material = "ice"
[[walls]]
polyline = [[0, 15], [1, 15], [2, 16]]
[[walls]]
polygon = [[1, 17], [2, 17], [2, 18]]
[[walls]]
wkt = "MULTILINESTRING ((0 19, 1 19), (2 19, 3 19, 3 19.5))"
)toml";

inline Loaded load_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return load_scenario_text(text, "s.toml", overrides);
}

inline std::string faults(const Loaded& loaded) {
  return to_string(loaded.diagnostics, "s.toml");
}

}  // namespace throng::testing
