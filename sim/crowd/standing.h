// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/crowd/crowd_cells.h"

namespace throng {

/// Discs that stand in the plane, asked whether there is room for one more.
class Standing {
 public:
  /// Forgets all.
  void clear();

  /// O(1) on average: a grid is made anew whenever there are many that it doesn't hold.
  void add(const Vec& centre, double radius);

  /// Whether a disc there would overlap one of them. O(near + some that were added last).
  bool meets(const Vec& centre, double radius);

 private:
  bool overlaps(std::size_t disc, const Vec& centre, double radius) const {
    const double reach = radius + radius_[disc];
    return (centre_[disc] - centre).squaredNorm() < reach * reach;
  }
  void sort();

  std::vector<Vec> centre_;     // m
  std::vector<double> radius_;  // m
  double largest_ = 0.0;        // m
  std::size_t sorted_ = 0;      // as many of them are in the cells
  CrowdCells cells_;
};

}  // namespace throng
