// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/crowd/region.h"
#include "sim/random.h"

namespace throng {

/// Places for discs in a region, at random: also in regions that fill little of their box.
class Sampler {
 public:
  /// For discs of that radius (m) or a larger one. O(kCells edges). `region` must outlive this.
  Sampler(const Region& region, double radius);

  /// A place, uniformly of those in the cells of a grid that discs could be in; whether one of that radius is
  /// wholly in the region there is for `holds` to say. Expects that it isn't empty.
  Vec draw(Random& random) const;

  /// Whether all of such a disc is in the region.
  bool holds(const Vec& centre, double radius) const;

  /// No disc fits anywhere.
  bool empty() const { return cells_.empty(); }

  static constexpr int kCells = 64;  ///< along the longer side of the region's box

 private:
  const Region& region_;
  double cell_ = 0.0;       // m
  std::vector<Vec> cells_;  // m, their lower left corners
};

}  // namespace throng
