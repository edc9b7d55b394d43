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
  bool meets(const Vec& centre, double radius) {
    return meets(centre, radius, [](const Vec&) { return true; });
  }

  /// Whether it would overlap one for whose centre (m) f(centre) is true; asks f of such alone, until then.
  template <class F>
  bool meets(const Vec& centre, double radius, F&& f);

 private:
  bool overlaps(std::size_t disc, const Vec& centre, double radius) const {
    const double reach = radius + radius_[disc];
    return (centre_[disc] - centre).squaredNorm() < reach * reach;
  }
  void sort_if_many_are_new();

  std::vector<Vec> centre_;     // m
  std::vector<double> radius_;  // m
  double largest_ = 0.0;        // m
  std::size_t sorted_ = 0;      // as many of them are in the cells
  CrowdCells cells_;
};

template <class F>
bool Standing::meets(const Vec& centre, double radius, F&& f) {
  sort_if_many_are_new();
  const auto is_met = [&](std::size_t disc) { return overlaps(disc, centre, radius) && f(centre_[disc]); };
  for (std::size_t disc = sorted_; disc < centre_.size(); ++disc)
    if (is_met(disc)) return true;
  if (sorted_ == 0) return false;
  bool found = false;
  cells_.for_each_stretch(centre, radius + largest_, [&](std::size_t first, std::size_t end) {
    for (std::size_t place = first; place < end && !found; ++place) found = is_met(cells_.row()[place]);
  });
  return found;
}

}  // namespace throng
