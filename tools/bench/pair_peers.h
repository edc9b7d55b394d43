// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "broadphase/pairs.h"
#include "tools/bench/clouds.h"

/// All pairs of a cloud as other libraries find them: built anew, then asked once for each point.
namespace throng::bench {

/// nanoflann's kd-tree of doubles, asked through a callback, which is faster than its lists.
void find_with_nanoflann(const Cloud& cloud, std::vector<broadphase::Pair>& pairs);

/// Box2D's tree of boxes in float, a hair larger than the points' reach; its finds are then tested in double.
void find_with_box2d_tree(const Cloud& cloud, std::vector<broadphase::Pair>& pairs);

}  // namespace throng::bench
