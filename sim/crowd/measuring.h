// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/crowd/crowd.h"
#include "sim/crowd/voronoi_density.h"
#include "sim/state.h"

namespace throng {

/// All that a crowd measures, step by step.
class Measuring {
 public:
  /// `crowd` must outlive this.
  explicit Measuring(const Crowd& crowd);

  bool empty() const { return crowd_.measures.empty(); }

  /// To be filled in: the steps of that many agents.
  std::span<Stride> strides(std::size_t agents) {
    strides_.resize(agents);
    return strides_;
  }

  /// Adds these steps, which end at the state.
  void measure(State& state);

 private:
  const Crowd& crowd_;
  std::vector<Stride> strides_;
  std::vector<OnLine> on_line_;                           // before the step
  std::vector<std::unique_ptr<VoronoiDensity>> voronoi_;  // as Crowd::measures, where wanted
};

}  // namespace throng
