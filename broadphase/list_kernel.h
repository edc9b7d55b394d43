// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "broadphase/cell_order.h"
#include "broadphase/proximity_search.h"

namespace throng::broadphase {

/// What is asked: who is within `radius` (m) of each point of `cells`, which are at least as wide; where
/// `own` isn't empty, row i looks own[i] far instead. The functions are compiled for each width of vectors
/// and chosen at run time; the answers are the same for each.
struct ListQuestion {
  const CellOrder& cells;
  const Period* period;
  double radius;
  std::span<const double> own;
};

/// Sets count[i] to how many neighbours the point at place i has, for places [first, end).
void count_neighbours(const ListQuestion& question, std::size_t first, std::size_t end, std::uint32_t* count);

/// Appends their lists, sorted, to `answers`.
void gather_neighbours(const ListQuestion& question, std::size_t first, std::size_t end, Answers& answers);

}  // namespace throng::broadphase
