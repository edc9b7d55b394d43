// SPDX-License-Identifier: MIT
#include "sim/crowd/measuring.h"

namespace throng {

Measuring::Measuring(const Crowd& crowd) : crowd_(crowd) {
  for (const Measure& measure : crowd.measures)
    voronoi_.push_back(measure.cutoff > 0.0 ? std::make_unique<VoronoiDensity>(crowd.walkable, measure.ground,
                                                                               measure.size, measure.cutoff)
                                            : nullptr);
}

void Measuring::measure(State& state) {
  on_line_.swap(state.crowd.on_line);
  state.crowd.on_line.clear();
  for (std::uint32_t i = 0; i < crowd_.measures.size(); ++i) {
    const Measure& its = crowd_.measures[i];
    throng::measure(its, strides_, state.step, state.crowd.measured[i], {i, on_line_, state.crowd.on_line});
    if (voronoi_[i] && its.is_on(state.step))
      state.crowd.measured[i].voronoi +=
          voronoi_[i]->density(std::span(state.position).last(state.crowd.stand.size()));
  }
}

}  // namespace throng
