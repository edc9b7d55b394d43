// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/lone_ways.h"
#include "sim/scene.h"

namespace throng {

/// Whether bodies, by row, may meet others: of whom two reaches have a point in common, and whom these may
/// get to when they push each other; all, where one of these may leave a periodic domain. O(bodies log
/// bodies) and the pairs of reaches, and O(bodies) for each time that those who push each other get to more.
std::vector<bool> may_meet(const Scene& scene, const std::vector<LoneWay>& ways);

}  // namespace throng
