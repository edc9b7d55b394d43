// SPDX-License-Identifier: MIT
#include "sim/measure/speeds.h"

namespace throng {

void append_speeds(const Scene& scene, const State& state, const Bins& bins, std::vector<double>& values) {
  const std::size_t first = values.size();
  values.resize(first + static_cast<std::size_t>(bins.count), 0.0);
  double all = 0.0;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    if (scene.bodies.kind[row] != BodyKind::dynamic) continue;
    all += 1.0;
    const double bin = state.velocity[row].norm() / bins.width();
    if (bin < bins.count) values[first + static_cast<std::size_t>(bin)] += 1.0;
  }
  for (std::size_t i = first; i < values.size(); ++i) values[i] /= all * bins.width();
}

}  // namespace throng
