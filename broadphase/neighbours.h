// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "broadphase/point_grid.h"

/// Who is near a place, and who is nearest: for sensing, and for questions asked from outside. For all pairs
/// at once `PointGrid::find_pairs` is faster.
namespace throng::broadphase {

struct Neighbour {
  std::uint32_t row;
  double distance;  ///< m, of the nearest image in a periodic domain
  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// What is asked for: the `most` nearest of those at most `radius` away.
struct Near {
  double radius = std::numeric_limits<double>::infinity();  ///< m, >= 0
  std::size_t most = std::numeric_limits<std::size_t>::max();
};

/// Replaces `neighbours` by the points near `p`, ascending by (distance, row). `except` is left out, as a
/// point itself is among its own neighbours. A point is at most `radius` away as `PointGrid` defines it. O(k
/// log k), k = the points within the radius, or where `most` are fewer about as many as those; at most O(n
/// log n). Allocates only to grow.
void find_near(const PointGrid& grid, const Point& p, const Near& near, std::vector<Neighbour>& neighbours,
               std::optional<std::uint32_t> except = {});

}  // namespace throng::broadphase
