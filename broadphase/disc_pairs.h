// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/point_grid.h"

/// Which discs may touch, whatever their sizes: discs of like size share a grid whose cells suit them, and
/// each disc asks the grids of the larger ones. The idea is that of the hierarchical hash grid (Mirtich 1996;
/// Ericson 2004, "Real-Time Collision Detection", 7.2).
namespace throng::broadphase {

class DiscPairs {
 public:
  /// Replaces `pairs` by all rows a < b with |c_a - c_b| <= reach[a] + reach[b] (m), ascending, each once.
  /// Where `movable` is not empty, pairs of which neither row is movable are left out.
  /// Expects finite reach >= 0, and with a period 4 max(reach) <= its shorter side; else as `PointGrid`.
  /// O(n (k + l)), k = mean number of discs near one, l = number of sizes, counted by the power of two.
  /// Allocates only to grow.
  void find(std::span<const Point> centres, std::span<const double> reach, const Period* period,
            std::vector<Pair>& pairs, std::span<const std::uint8_t> movable = {});

 private:
  /// Discs of like reach, in a grid of their own.
  struct Level {
    double reach = 0.0;  // m, the largest
    std::vector<std::uint32_t> rows;
    std::vector<Point> centres;
    std::vector<double> reaches;
    PointGrid grid;
  };

  std::size_t choose_levels(std::span<const double> reach);
  void fill_levels(std::span<const Point> centres, std::span<const double> reach, const Period* period);
  void gather_within(Level& level);
  void gather_between(const Level& fine, const Level& coarse);

  std::vector<Level> levels_;  // from coarse to fine; the first count_ are in use
  std::size_t count_ = 0;
  std::vector<std::uint32_t> of_octave_;  // per power of two below the largest reach: its level
  PointGrid grid_;                        // of all, where one level does
  PairBuffer found_, local_;
  PairSorter sorter_;
};

}  // namespace throng::broadphase
