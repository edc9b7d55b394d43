// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
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

/// The neighbours of many, one list after the other.
struct NeighbourLists {
  std::vector<std::size_t> first;  ///< list i is all[first[i]] up to all[first[i + 1]]
  std::vector<Neighbour> all;

  std::span<const Neighbour> operator[](std::size_t i) const {
    return std::span(all).subspan(first[i], first[i + 1] - first[i]);
  }
};

/// Replaces `lists` by one list per point of the grid, in order of rows: what `find_near` finds for it,
/// except itself. Expects `points` to be what the grid was built from. Allocates only to grow.
void find_all_near(const PointGrid& grid, std::span<const Point> points, const Near& near,
                   NeighbourLists& lists);

}  // namespace throng::broadphase
