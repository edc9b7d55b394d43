// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "narrowphase/orientation.h"
#include "sim/crowd/barriers.h"
#include "sim/crowd/region.h"

namespace throng::bench {

/// The definition that distance fields are held against, in tests and benchmarks: the shortest way to a point
/// goes over corners of barriers that see one another. O(corners²) to build and O(corners) to ask, each by
/// looking at all barriers.
class Geodesic {
 public:
  Geodesic(const Region& walkable, const Barriers& barriers, const Vec& goal)
      : walkable_(walkable), barriers_(barriers), goal_(goal) {
    for (const auto& segment : barriers.segments()) corners_.push_back(segment.a);
    distance_.assign(corners_.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < corners_.size(); ++i)
      if (sees(corners_[i], goal)) distance_[i] = (corners_[i] - goal).norm();
    for (std::size_t round = 0; round < corners_.size(); ++round)
      for (std::size_t i = 0; i < corners_.size(); ++i)
        for (std::size_t k = 0; k < corners_.size(); ++k)
          if (distance_[k] + (corners_[i] - corners_[k]).norm() < distance_[i] &&
              sees(corners_[i], corners_[k]))
            distance_[i] = distance_[k] + (corners_[i] - corners_[k]).norm();
  }

  double distance(const Vec& p) const {
    double least = sees(p, goal_) ? (p - goal_).norm() : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners_.size(); ++i)
      if (distance_[i] + (p - corners_[i]).norm() < least && sees(p, corners_[i]))
        least = distance_[i] + (p - corners_[i]).norm();
    return least;
  }

 private:
  /// A barrier that is only touched blocks nothing, and one may walk along it.
  bool sees(const Vec& p, const Vec& q) const {
    using narrowphase::orientation;
    for (const auto& [a, b, at_a, at_b] : barriers_.segments())
      if (orientation(p, q, a) * orientation(p, q, b) < 0 && orientation(a, b, p) * orientation(a, b, q) < 0)
        return false;
    const Vec middle = 0.5 * (p + q);
    return contains(walkable_, middle) || barriers_.distance(middle, 1.0) < 1e-9;
  }

  const Region& walkable_;
  const Barriers& barriers_;
  Vec goal_;
  std::vector<Vec> corners_;
  std::vector<double> distance_;
};

inline std::vector<Vec> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline std::vector<BarrierLine> edges(const Region& region) {
  std::vector<BarrierLine> lines;
  for (const auto& ring : region.rings) lines.push_back({ring, true});
  return lines;
}

}  // namespace throng::bench
