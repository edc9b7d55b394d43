// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "sim/simulation.h"

namespace throng {

/// What the event-driven engine can't do of the scene: "PATH: why", "" where it can do all of it. O(bodies).
std::string event_driven_refusal(const Scene& scene);

/// Hard discs from collision to collision, see HardDiscs: no error but rounding, at any dt, which is only how
/// often the state is written out. Of dynamic discs with restitution and friction among walls, static bodies
/// and the domain's borders, with or without constant gravity. One thread. Throws InputError where discs
/// overlap.
std::unique_ptr<Simulation> event_driven_simulation(const Scene& scene);

}  // namespace throng
