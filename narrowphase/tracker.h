// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/closest.h"
#include "narrowphase/distance.h"

namespace throng::narrowphase {

/// `separation` for shapes that are asked again and again while they move a little: the search begins at
/// `features`, where it ended the last time, and leaves there what it found. Whatever they held, be it of
/// other shapes, the answer is right within the same error; of several features equally close it names those
/// that it meets first. `statistics`, where given, is added to; where the features still hold, it isn't
/// touched.
///
/// The search walks from neighbour to neighbour, each closer than the last (Lin and Canny 1991; by signs
/// alone as Mirtich 1998), mostly over one or two. What it ends with counts only if it proves itself: all of
/// a on one side of the gap and all of b on the other. A walk that ends in an overlap or takes too long is
/// replaced by a search from nothing. O(1) for small motions, the depth of shapes that overlap O(n + m).
/// Allocates nothing.
Separation track(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b,
                 ClosestFeatures& features, SearchStatistics* statistics = nullptr);

}  // namespace throng::narrowphase
