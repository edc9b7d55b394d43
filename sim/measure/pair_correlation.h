// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/measure/asked.h"
#include "sim/state.h"

namespace throng {

/// g(r), how much likelier two dynamic bodies' centres are r apart than if all stood anywhere: appends for
/// each bin the pairs that are so far apart over those to be expected of as many points spread evenly. These
/// are known in closed form in a domain that repeats, and in a box, where centres keep the mean radius off
/// the walls (the distance of two points in a rectangle: Philip, TRITA MAT 07 MA 10, 2007); so they are of
/// those whose centres are in `correlation_within`, where that is asked. 1 throughout for points of no size,
/// 0 where there is no pair; the bin of a distance r holds r too. Expects correlation_refusal() to be "".
/// O(pairs).
void append_pair_correlation(const Scene& scene, const State& state, const Bins& bins,
                             std::vector<double>& values);

/// Why that can't be told so far out, "" where it can.
std::string correlation_refusal(const Scene& scene, double up_to);

}  // namespace throng
