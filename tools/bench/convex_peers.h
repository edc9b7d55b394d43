// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tools/bench/convex_pairs.h"

/// Others' answers to the questions of convex_pairs.h.
namespace throng::bench {

/// Box2D 2.4.1's b2Distance, in single precision, without a depth. Polygons of up to eight corners.
class Box2dDistance {
 public:
  static constexpr std::size_t kMostVertices = 8;

  /// `warm`: each pair's simplex is kept.
  Box2dDistance(const ConvexPairs& pairs, bool warm);
  ~Box2dDistance();

  double distance(std::size_t pair, std::size_t placement);  ///< m, 0 where they overlap

 private:
  struct Pairs;
  std::unique_ptr<Pairs> pairs_;
  bool warm_;
};

/// CGAL's Polytope_distance_d over the rationals: exact but for one square root. m, 0 where they overlap.
double cgal_distance(const narrowphase::Convex& a, const narrowphase::Convex& b, const Placement& placement);

}  // namespace throng::bench
