// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "sim/scene.h"
#include "sim/state.h"

namespace throng {

/// Pairs that are inside each other: bodies with bodies, walls and the domain's box, by the exact
/// narrowphase; agents with agents and the places of walls that are nearest to them.
struct Overlap {
  std::size_t pairs = 0;  ///< overlapping pairs of convex parts
  double max = 0.0;       ///< m, the deepest; 0 where nothing overlaps
  double mean = 0.0;      ///< m, over the overlapping pairs
};

Overlap overlap(const Scene& scene, const State& state);

/// m, of each body of a scene without agents: how deep it is in the one that it is deepest in.
std::vector<double> deepest_overlaps(const Scene& scene, const State& state);

}  // namespace throng
