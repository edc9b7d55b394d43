// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/crowd/region.h"

namespace throng {

/// Answers for many points what `contains` does for one, with its edges sorted into strips of the plane.
class Inside {
 public:
  Inside() = default;
  explicit Inside(const Region& region) { set(region); }

  /// Takes a copy of the region's edges. O(edges): at most 17 entries of 4 bytes for each; allocates only to
  /// grow.
  void set(const Region& region);

  /// As contains(region, p). O(edges at the height of p).
  bool operator()(const Vec& p) const;

 private:
  struct Edge {
    Vec low, high;  ///< m, by y
  };
  std::size_t strip(double y) const;

  std::vector<Edge> edges_;
  Eigen::AlignedBox2d bounds_;        // m
  double per_strip_ = 0.0;            // 1/m
  std::vector<std::uint32_t> start_;  // of each strip and behind the last
  std::vector<std::uint32_t> row_;    // of edges, by strip
  std::vector<std::uint32_t> next_;   // of each strip: where its next row goes
};

}  // namespace throng
