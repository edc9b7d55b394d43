// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/state.h"

namespace throng::bench {

/// People on a square, 2 m² each, every one at a pace (1.34 m/s, standard deviation 0.26) and in a direction
/// of their own, from which pushes of 1 m/s² or so lead away for half a second: a scene of them, and its
/// states each 0.04 s, as films have them. The same in every run.
Scene crowd_scene(std::size_t people);
std::vector<State> crowd_motion(const Scene& scene, std::size_t frames);

}  // namespace throng::bench
