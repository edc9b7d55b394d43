// SPDX-License-Identifier: MIT
#pragma once

#include "sim/random.h"

namespace throng {

inline constexpr double kMostBearing = 3e-3;  ///< rad

/// rad, by how much the agent of that id walks left of his way, always: at random by (seed, id), up to
/// kMostBearing to either side. Else two whose ways cross would meet in one point, and hold each other up
/// there until rounding parts them; a way gets longer by less than 5e-6 of it.
inline double bearing(std::uint64_t seed, std::uint32_t id) {
  return Random(seed, 0, id, Purpose::bearing).uniform(-kMostBearing, kMostBearing);
}

}  // namespace throng
