// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

/// `separation` of many pairs of discs at once.
namespace throng::narrowphase {

/// One array per quantity, a row per disc; all of one size.
struct Discs {
  std::span<const double> x, y;    ///< m, of the centre
  std::span<const double> radius;  ///< m
};

/// A row per pair, as in Separation; the other witness point is point + distance * normal.
struct DiscGaps {
  std::vector<double> distance;            ///< m, below 0 in overlap
  std::vector<double> normal_x, normal_y;  ///< unit, from a to b; the x axis where the centres coincide
  std::vector<double> point_x, point_y;    ///< m, on the rim of a, nearest to (or deepest in) b
};

/// Replaces `gaps` by those between row i of `a` and row i of `b`. Expects as many rows of both, distances
/// between centres that are 0 or from 1e-140 to 1e150 m. About 1 ns a pair; allocates only to grow.
void find_gaps(const Discs& a, const Discs& b, DiscGaps& gaps);

}  // namespace throng::narrowphase
