// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sim/scene.h"

namespace throng {

/// A straight piece of wall.
struct StraightRun {
  Vec from, to;  ///< m
  std::uint32_t material;
};

/// The walls with the points along straight lines left out, so that what slides along a wall stays with one
/// piece: segments that go on where another of the same material ends, of one wall or of several. A wall
/// moves by rounding alone (`narrowphase::weld`). Points at which more than two segments meet stay, also
/// those at which one ends on another. What stands twice, of one material, is there once. O(n log n).
std::vector<StraightRun> straight_runs(std::span<const Wall> walls);

}  // namespace throng
