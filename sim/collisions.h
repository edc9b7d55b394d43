// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace throng {

/// What a gas tells of itself by its collisions, since the run began.
struct Collisions {
  std::int64_t pairs = 0;  ///< of two discs
  std::int64_t walls = 0;  ///< of a disc with what stands still
  double virial = 0.0;     ///< N m s: of pairs, the sum of their distances times their impulses
};

}  // namespace throng
