// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/motion_cases.h"
#include "tools/bench/motion_reference.h"

namespace throng::bench {

/// When the solids of each query first touch, by `first_touch` over all pairs of their parts. Takes the
/// queries away that graze, where 50 digits would not be enough to tell.
std::vector<std::optional<double>> truth(MotionCase& c);

/// How far apart the two of a query are at a time, by the definition, in long double. m, signed.
double exact_gap(const MotionQuery& query, double time);

}  // namespace throng::bench
