// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "sim/simulation.h"

namespace throng::bench {

/// The scene on Chipmunk 7 with its own defaults, 10 iterations among them, a hash of cells as wide as the
/// mean body and a slop of 5 mm, Box2D's; null where it was built without Chipmunk, or where the scene
/// repeats.
std::unique_ptr<Simulation> chipmunk_simulation(const Scene& scene, int iterations = 10);

}  // namespace throng::bench
