// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/benchmarks.h"

namespace throng::bench {

/// The table of the lectures, for disc, box and oriented box: how tight on real shapes, what a test costs,
/// how much a turn of the shape changes it, bytes.
std::vector<Row> bvh_volume_rows(const Options& options);

}  // namespace throng::bench
