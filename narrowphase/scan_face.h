// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/face.h"

namespace throng::narrowphase {

/// widest_face() by all edges of `a` and all vertices of `b`, without a branch to mispredict: O(n m) of a
/// fraction of a nanosecond.
Face scan_face(const Convex& a, const Convex& b, const Pose& b_in_a);

}  // namespace throng::narrowphase
