// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "narrowphase/closest.h"
#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// The closest features of two polygons or segments, by the method of Gilbert, Johnson and Keerthi (1988) in
/// the plane, from any features of theirs; none where they overlap. Up to rounding: `probe` proves what it
/// finds or refutes it. By signs and repeated supports alone, so without a tolerance. O(k s), s = cost of
/// `support`, k mostly 3 or 4. Allocates nothing.
std::optional<ClosestFeatures> gjk(const Convex& a, const Convex& b, const Pose& b_in_a,
                                   const ClosestFeatures& from);

}  // namespace throng::narrowphase
