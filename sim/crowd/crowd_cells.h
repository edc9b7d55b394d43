// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/cells.h"
#include "sim/crowd/region.h"

namespace throng {

/// Agents in the order of the cells that they stand in, which each have a place in an array: who is near in
/// the plane is near in memory. The order depends on where they stand and on the order of their rows, on
/// nothing else.
class CrowdCells {
 public:
  /// Sorts them into cells half as wide as `reach` (m, above 0), wider where that would be many more cells
  /// than agents. O(n); allocates only to grow.
  void sort(std::span<const Vec> position, double reach);

  /// The row of each place; ascending in each cell.
  std::span<const std::uint32_t> row() const { return row_; }

  /// Calls f(first, end) for stretches of places, ascending, that hold all who stand at most `reach` (m) from
  /// `p`, and others. None is in two of them.
  template <class F>
  void for_each_stretch(const Vec& p, double reach, F&& f) const {
    broadphase::Range range;
    if (row_.empty() || !cells_.range(p, reach, range)) return;
    for (std::int64_t y = range.first.y; y <= range.last.y; ++y) {
      const std::size_t bucket = cells_.bucket({range.first.x, y});
      f(std::size_t{start_[bucket]},
        std::size_t{start_[bucket + static_cast<std::size_t>(range.last.x - range.first.x) + 1]});
    }
  }

 private:
  broadphase::Cells cells_;
  std::vector<std::uint32_t> start_, bucket_, row_;
};

}  // namespace throng
