// SPDX-License-Identifier: MIT
#include "sim/simulation_error.h"

#include <cstdio>

namespace throng {

void fail_at_body(const State& state, std::size_t row) {
  char text[256];
  std::snprintf(text, sizeof text, "step %lld: body %u is at (%g, %g) with velocity (%g, %g), spin %g",
                static_cast<long long>(state.step), state.id[row], state.position[row].x(),
                state.position[row].y(), state.velocity[row].x(), state.velocity[row].y(), state.spin[row]);
  throw SimulationError(text);
}

}  // namespace throng
