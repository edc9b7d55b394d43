// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>

#include "sim/state.h"

namespace throng {

/// A run that can't go on: the message names step and body. The program ends with exit code 1.
struct SimulationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr double kFarthestPlace = 1e12;  ///< m; the spacing of doubles there is 0.1 mm

/// Throws SimulationError that names the step, the body and where it is.
[[noreturn]] void fail_at_body(const State& state, std::size_t row);

/// Whether that place is one that a run bears: nearer than kFarthestPlace.
inline bool is_near(const Vec& place) {
  return std::abs(place.x()) < kFarthestPlace && std::abs(place.y()) < kFarthestPlace;
}

/// Whether a step can begin with the body in that row: it is near, its angle and the squares of velocity and
/// spin are finite.
inline bool can_go_on(const State& state, std::size_t row) {
  const double spin = state.spin[row];
  const double motion = state.velocity[row].squaredNorm() + spin * spin + state.angle[row];
  return is_near(state.position[row]) && motion - motion == 0.0;
}

/// Throws as fail_at_body() where the body can't go on.
inline void check_body(const State& state, std::size_t row) {
  if (!can_go_on(state, row)) fail_at_body(state, row);
}

}  // namespace throng
