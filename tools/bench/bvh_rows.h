// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/benchmarks.h"

namespace throng::bench {

/// The table of the bounding volumes on real shapes: area over that of the hull of what they hold, as built
/// and with the shape turned (1 is tight; equal figures don't mind turns), and what a test of two takes.
std::vector<Row> bvh_volume_rows(const Options& options);

/// Two polygons of convex parts that turn a little between questions: from nothing, from the parts that were
/// nearest, and with each pair of parts' closest features.
std::vector<Row> bvh_part_rows(const Options& options);

}  // namespace throng::bench
