// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sim/scene.h"
#include "sim/simulation.h"
#include "sim/state.h"

namespace throng::bench {

/// A scene of the gallery, with overrides. Throws InputError where it doesn't load.
Scene gallery_scene(const std::string& folder, const std::string& name,
                    const std::vector<std::string>& overrides = {});

/// The same scene, begun where the state is.
Scene begun_at(Scene scene, const State& state);

/// Steps a simulation of the scene until `seconds` of its time have passed, and says so.
void settle(Simulation& simulation, const Scene& scene, double seconds);

/// The same scene, begun where the native engine has brought it after `seconds`.
Scene settled(Scene scene, double seconds);

/// That scene of discs in a box and, in turn, its mirror image, so many times side by side in one box: who
/// lay at a side lies beside his image then. The images of a body follow each other, so that rows say as
/// little of places as before.
Scene side_by_side(const Scene& scene, int copies);

}  // namespace throng::bench
