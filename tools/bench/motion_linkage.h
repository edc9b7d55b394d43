// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/options.h"
#include "tools/bench/rows.h"

namespace throng::bench {

/// The cases of bench_motion about arms of 2, 4 and 10 links, among 1,000 obstacles or by themselves:
/// bisection, first contact, sampling over the same hierarchies.
std::vector<Row> motion_linkage_rows(const Options& options);

}  // namespace throng::bench
