// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "tools/bench/accuracy/body_state.h"

namespace throng::bench {

/// Equal elastic discs in a row along x, ascending and a diameter apart or more, after t (s): Newton's
/// cradle. Collisions of equal masses swap velocities, so that with diameters taken out of the coordinates
/// they pass through one another, and the kth from the left is the kth of the straight lines:
/// sort(x_i - i d + v_i t) + i d. Source: Tonks, Phys. Rev. 50, 955 (1936). O(n log n).
std::vector<BodyState> exact_row(std::span<const BodyState> start, double diameter, double t);

}  // namespace throng::bench
