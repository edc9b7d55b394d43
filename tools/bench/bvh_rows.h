// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/benchmarks.h"

namespace throng::bench {

/// The table of the lectures on real shapes: how tight each kind of volume is, how much a turn of the shape
/// changes it, and what a million tests take, whether two are apart and, `bound_ms`, how far.
std::vector<Row> bvh_volume_rows(const Options& options);

/// Two polygons of convex parts that turn a little between questions: from nothing, from the parts that were
/// nearest, and with each pair of parts' closest features.
std::vector<Row> bvh_part_rows(const Options& options);

}  // namespace throng::bench
