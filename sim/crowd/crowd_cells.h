// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/cells.h"
#include "sim/crowd/region.h"

namespace throng {

/// Agents in the order of the cells that they stand in, which each have a place in an array: who is near in
/// the plane is near in memory. The order depends on where they stand and on the order of their rows, or on
/// their names, on nothing else.
class CrowdCells {
 public:
  /// Sorts them into cells as high as `reach` (m, above 0) and kFlat times narrower, larger ones where these
  /// would be many more than agents; in each cell ascending by row, or by id where ids are given. O(n);
  /// allocates only to grow.
  void sort(std::span<const Vec> position, double reach, std::span<const std::uint32_t> id = {});

  /// The row of each place.
  std::span<const std::uint32_t> row() const { return row_; }

  /// Places first to end - 1.
  struct Stretch {
    std::size_t first, end;
  };

  /// The cells that hold all who stand at most `reach` (m) from `p`, and others. False where nobody is.
  bool find(const Vec& p, double reach, broadphase::Range& cells) const {
    if (row_.empty()) return false;
    const Vec far(reach + kRounding * (std::abs(p.x()) + reach),
                  reach + kRounding * (std::abs(p.y()) + reach));
    return cells_.range(squared(p - far), squared(p + far), cells);
  }

  /// Those in row `y` of these cells; nobody is in the stretches of two rows.
  Stretch stretch(const broadphase::Range& cells, std::int64_t y) const {
    const std::size_t bucket = cells_.bucket({cells.first.x, y});
    return {start_[bucket], start_[bucket + static_cast<std::size_t>(cells.last.x - cells.first.x) + 1]};
  }

  /// Calls f(first, end) for the stretches of places, ascending, that `find` finds.
  template <class F>
  void for_each_stretch(const Vec& p, double reach, F&& f) const {
    broadphase::Range range;
    if (!find(p, reach, range)) return;
    for (std::int64_t y = range.first.y; y <= range.last.y; ++y) {
      const Stretch places = stretch(range, y);
      f(places.first, places.end);
    }
  }

 private:
  static constexpr double kFlat = 4.0;  // three rows of such cells hold all who are near, and few others
  static constexpr double kRounding = 0x1p-49;

  /// In the plane in which cells are square. Exact.
  static Vec squared(const Vec& p) { return {kFlat * p.x(), p.y()}; }

  void order_by(std::span<const std::uint32_t> id);

  broadphase::Cells cells_;
  std::vector<std::uint32_t> start_, bucket_, row_;
};

}  // namespace throng
