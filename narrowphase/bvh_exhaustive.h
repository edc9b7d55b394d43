// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/bvh_outline.h"

/// What the hierarchies' answers mean, without a hierarchy: all edges against all. For tests and benchmarks.
namespace throng::narrowphase {

/// As `proximity`, with lower == upper where the two are apart; lower is minus infinity where they aren't.
/// O(n m).
OutlineProximity exhaustive_proximity(std::span<const OutlineEdge> a, const Pose& pose_a,
                                      std::span<const OutlineEdge> b, const Pose& pose_b);

/// As `find_meetings`. O(n m).
std::vector<std::pair<std::uint32_t, std::uint32_t>> exhaustive_meetings(std::span<const OutlineEdge> a,
                                                                         const Pose& pose_a,
                                                                         std::span<const OutlineEdge> b,
                                                                         const Pose& pose_b);

/// As `nearest`, the first of several. O(n).
OutlinePoint exhaustive_nearest(std::span<const OutlineEdge> shape, const Vec& point);

/// As `contains`. O(n).
bool exhaustive_contains(std::span<const OutlineEdge> shape, const Vec& point);

}  // namespace throng::narrowphase
