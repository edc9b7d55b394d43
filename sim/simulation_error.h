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

/// The same where the body in that row has a velocity that is no number, or is farther out than
/// kFarthestPlace.
inline void check_body(const State& state, std::size_t row) {
  const Vec& p = state.position[row];
  const Vec& v = state.velocity[row];
  const double motion = v.x() + v.y() + state.spin[row] + state.angle[row];
  const bool sound =
      std::abs(p.x()) < kFarthestPlace && std::abs(p.y()) < kFarthestPlace && motion - motion == 0.0;
  if (!sound) fail_at_body(state, row);
}

}  // namespace throng
