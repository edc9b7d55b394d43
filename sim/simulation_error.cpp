// SPDX-License-Identifier: MIT
#include "sim/simulation_error.h"

#include <cmath>
#include <cstdio>

namespace throng {

namespace {

constexpr double kFarthest = 1e12;  // m; the spacing of doubles there is 0.1 mm

[[noreturn]] void fail(const State& state, std::size_t row) {
  char text[256];
  std::snprintf(text, sizeof text, "step %lld: body %u is at (%g, %g) with velocity (%g, %g), spin %g",
                static_cast<long long>(state.step), state.id[row], state.position[row].x(),
                state.position[row].y(), state.velocity[row].x(), state.velocity[row].y(), state.spin[row]);
  throw SimulationError(text);
}

}  // namespace

void check_body(const State& state, std::size_t row) {
  const Vec& p = state.position[row];
  const Vec& v = state.velocity[row];
  const double motion = v.x() + v.y() + state.spin[row] + state.angle[row];
  const bool sound = std::abs(p.x()) < kFarthest && std::abs(p.y()) < kFarthest && motion - motion == 0.0;
  if (!sound) fail(state, row);
}

}  // namespace throng
