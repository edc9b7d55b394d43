// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/distance.h"

namespace throng::narrowphase {

/// What `separation` means, without any cleverness and in long double: every vertex against every edge, every
/// axis. The tests' definition of distance and depth; far too slow for anything else. O(n m (n + m)).
Separation exhaustive_separation(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b);

}  // namespace throng::narrowphase
