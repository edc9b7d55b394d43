// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "narrowphase/convex.h"

namespace throng::bench {

/// Where the two shapes of a pair stand at one time.
struct Placement {
  narrowphase::Pose a, b;
};

/// Many pairs of convex polygons at many times: what `throng bench narrowphase` asks about.
struct ConvexPairs {
  std::string name;
  std::vector<narrowphase::Convex> shapes;
  std::vector<std::uint32_t> a, b;    ///< which shapes a pair has
  std::vector<Placement> placements;  ///< all pairs at the first time, then at the next
  bool coherent;                      ///< a pair moves little from time to time

  std::size_t pairs() const { return a.size(); }
};

/// How far apart the pairs of a case stand.
enum class Gap { near, touching, overlapping };

/// As "coherent 8 vertices 0.01 rad near".
std::string case_name(std::size_t vertices, double step, Gap gap);

/// Pairs of polygons with `vertices` corners on circles of radius 1, of eight kinds that pairs share. They
/// turn against each other by `step` (rad) from time to time; with step 0 they stand anew each time. Near:
/// up to half a radius apart; touching: as near to 0 as doubles get; overlapping: about a third of a radius
/// deep.
ConvexPairs convex_pairs(std::size_t vertices, double step, Gap gap, bool quick);

}  // namespace throng::bench
