// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// On which side of the line from `a` to `b` the point `c` lies: 1 left, -1 right, 0 exactly on it. Never
/// wrong by rounding: a filter settles nearly all, the rest is summed exactly as an expansion (Shewchuk
/// 1997). Expects coordinates that are 0 or between 1e-140 and 1e150 in size. About 3 ns, 150 ns where the
/// filter fails.
int orientation(const Vec& a, const Vec& b, const Vec& c);

}  // namespace throng::narrowphase
