// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

#include "sim/state.h"

namespace throng {

/// A run that can't go on: the message names step and body. The program ends with exit code 1.
struct SimulationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws SimulationError where the body in that row has a velocity or place that is no number, or is farther
/// out than positions can be told apart.
void check_body(const State& state, std::size_t row);

}  // namespace throng
