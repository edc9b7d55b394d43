// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/neighbours.h"

namespace throng::bench {

/// Replaces `lists` by the neighbours of every point among the others, by CGAL's kd-tree, built anew: all
/// within `near.radius`, or where fewer than all are asked for, the nearest `near.most`. Sorted by distance.
void cgal_neighbours(const std::vector<broadphase::Point>& points, const broadphase::Near& near,
                     broadphase::NeighbourLists& lists);

}  // namespace throng::bench
