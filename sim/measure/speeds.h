// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/measure/asked.h"
#include "sim/state.h"

namespace throng {

/// The distribution of dynamic bodies' speeds: appends for each bin, from 0 on, which part of all bodies is
/// in it over its width (s/m). Who is as fast as `bins.up_to` or faster is in none: the sum over the bins
/// times their width lacks him. 0/0 where nobody is dynamic. O(bodies).
void append_speeds(const Scene& scene, const State& state, const Bins& bins, std::vector<double>& values);

}  // namespace throng
