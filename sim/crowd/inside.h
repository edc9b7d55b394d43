// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sim/crowd/region.h"

namespace throng {

/// Answers for many points what `contains` does for one, and which ways cross the region's border, with its
/// edges sorted into strips of the plane.
class Inside {
 public:
  Inside() = default;
  explicit Inside(const Region& region) { set(region); }

  /// Takes a copy of the region's edges. O(edges): at most 17 entries of 4 bytes for each; allocates only to
  /// grow.
  void set(const Region& region);

  /// As contains(region, p). O(edges at the height of p).
  bool operator()(const Vec& p) const;

  /// Whether the straight way from `a` to `b` meets the region's border, be it by touching: who is outside
  /// before and after it and crosses the region does. Exact. O(edges at its heights); O(1) where it is
  /// outside the region's box.
  bool meets_border(const Vec& a, const Vec& b) const;

 private:
  struct Edge {
    Vec low, high;  ///< m, by y
    /// Whether its box meets the other one.
    bool comes_to(const Eigen::AlignedBox2d& box) const {
      return low.y() <= box.max().y() && high.y() >= box.min().y() &&
             std::min(low.x(), high.x()) <= box.max().x() && std::max(low.x(), high.x()) >= box.min().x();
    }
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
