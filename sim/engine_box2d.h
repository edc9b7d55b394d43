// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "sim/simulation.h"

namespace throng {

/// What Box2D can't do of the scene: "PATH: why", "" where it can do all of it. O(bodies + vertices).
std::string box2d_refusal(const Scene& scene);

/// The same scene on Box2D 2.4.1: a second opinion, and a peer to be measured against. One b2World::Step a
/// step, with 2 n velocity and n - 1 (at least 1) position iterations for n substeps: 4 are the 8 and 3 that
/// its manual recommends. Throws InputError for what Box2D can't do: periodic domains, contact.model none,
/// parts thinner than its tolerance; the loader has asked `box2d_refusal` before.
std::unique_ptr<Simulation> box2d_simulation(const Scene& scene);

}  // namespace throng
