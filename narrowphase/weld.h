// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// A number for each point, the same for points that are one but for rounding: 16 units in the last place of
/// the largest coordinate apart or less. Numbers count from 0 in the order of the points. O(n log n).
std::vector<std::uint32_t> weld(std::span<const Vec> points);

/// What `weld` takes for rounding among those points (m).
double rounding(std::span<const Vec> points);

}  // namespace throng::narrowphase
