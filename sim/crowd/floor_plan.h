// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/crowd/region.h"

/// A grid over the walkable area that says where an agent of some size can stand: the ground that distance
/// fields are built on.
namespace throng {

enum class Footing : std::uint8_t {
  none,    ///< outside the walkable area, or on a barrier
  closed,  ///< walkable, and across a passage that is too narrow
  tight,   ///< walkable, and less than a cell's diagonal from a barrier, which may cross the cells round it
  close,   ///< walkable, and nearer to a barrier than the clearance
  free
};

struct FloorPlan {
  Vec origin{0.0, 0.0};  ///< m, of node 0
  double cell = 0.0;     ///< m, from node to node
  int columns = 0, rows = 0;
  double clearance = 0.0;  ///< m
  std::vector<Footing> footing;

  std::size_t size() const { return footing.size(); }
  Vec node(std::size_t i) const {
    const auto width = static_cast<std::size_t>(columns);
    return origin + cell * Vec(static_cast<double>(i % width), static_cast<double>(i / width));
  }
};

/// How fine a plan must be, and how far from barriers it keeps.
struct Resolution {
  double cell = 0.0, clearance = 0.0;  ///< m
};

/// How wide the passages are (m) that are at least `least` and at most `most` wide, ascending, each once: the
/// lengths of the straight ways over the floor between two barriers that don't meet. O(barriers near one
/// another).
std::vector<double> passages(const Region& walkable, const Barriers& barriers, double least, double most);

/// Eight cells across the narrowest passage that an agent of that radius (m) fits through, four across the
/// agent where that is less, and no more than kMostNodes in all. The clearance is the radius, less where that
/// would close the narrowest passage. O(barriers near one another).
Resolution resolution_for(const Region& walkable, const Barriers& barriers, double radius);

/// m: who is of that radius gets through what is wider than that, and not through what is as wide as he is,
/// whatever of its ends was rounded.
inline double closed_to(double radius) {
  return 2.0 * radius * (1.0 + 1e-6);
}

inline constexpr double kMostNodes = 4e6;

/// How many nodes a plan of these cells has: its columns times its rows.
double plan_nodes(const Region& walkable, const Resolution& resolution);

/// Passages no wider than `closed` (m) are closed. O(nodes + barriers' length /
/// cell).
FloorPlan floor_plan(const Region& walkable, const Barriers& barriers, const Resolution& resolution,
                     double closed);

}  // namespace throng
