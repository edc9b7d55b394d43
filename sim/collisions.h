// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace throng {

/// What a gas tells of itself by its collisions, since the run began.
struct Collisions {
  std::int64_t pairs = 0;    ///< of two discs
  std::int64_t walls = 0;    ///< of a disc with what stands still
  std::int64_t pushed = 0;   ///< steps whose collisions weren't counted, as discs overlapped and were pushed
  double virial = 0.0;       ///< N m s: of pairs, the sum of their distances times their impulses
  double equilibrium = 0.0;  ///< m kg^(1/2): the virial to be expected in equilibrium, over sqrt(k T)

  Collisions& operator+=(const Collisions& more);

  /// Of a pair that touches at `distance` (m), by an impulse (N s); `inverse_mass` (1/kg): of both together.
  void add_pair(double distance, double impulse, double inverse_mass);

  friend bool operator==(const Collisions&, const Collisions&) = default;
};

}  // namespace throng
