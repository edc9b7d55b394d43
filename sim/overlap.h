// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/state.h"
#include "sim/workers.h"

namespace throng {

/// Pairs that are inside each other: bodies with bodies, walls and the domain's box, by the exact
/// narrowphase; agents with agents and the places of walls that are nearest to them.
struct Overlap {
  std::size_t pairs = 0;  ///< overlapping pairs of convex parts
  double max = 0.0;       ///< m, the deepest; 0 where nothing overlaps
  double mean = 0.0;      ///< m, over the overlapping pairs
};

class Candidates;

/// Looks for them in states of one scene, which must outlive it: what never moves is indexed once.
class Overlaps {
 public:
  explicit Overlaps(const Scene& scene);
  ~Overlaps();

  Overlap of(const State& state);

  /// m, of each body of a scene without agents: how deep it is in the one that it is deepest in.
  std::vector<double> deepest(const State& state);

 private:
  template <class F>
  void for_each(const State& state, F f);

  const Scene& scene_;
  const Plan plan_;
  Workers alone_{1};
  std::unique_ptr<Candidates> candidates_;  // null where bodies don't meet
};

Overlap overlap(const Scene& scene, const State& state);

}  // namespace throng
