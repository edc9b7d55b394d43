// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/pairs.h"
#include "broadphase/point.h"

namespace throng::bench {

/// What throng's all pairs have to beat: the grid as a good programmer writes it in an hour. A dense array of
/// square cells over the bounding box, a counting sort, points copied in the order of their cells, half of
/// the nine cells in contiguous runs, pairs written one behind the other. Kept free of tricks.
class PlainGrid {
 public:
  /// Replaces `pairs` by all rows at most `reach` apart; where `radii` isn't empty by those at most
  /// r_a + r_b apart, and expects reach >= 2 max(radii). Memory in proportion to the bounding box.
  void find(std::span<const broadphase::Point> points, double reach, std::span<const double> radii,
            broadphase::PairBuffer& pairs);

 private:
  void sort(std::span<const broadphase::Point> points, double reach, std::span<const double> radii);
  template <class Most>
  void gather(const Most& most, broadphase::PairBuffer& pairs) const;

  std::size_t columns_ = 0, rows_of_cells_ = 0;
  std::vector<std::uint32_t> cell_, start_, row_;
  std::vector<broadphase::Point> point_;
  std::vector<double> radius_;
};

}  // namespace throng::bench
