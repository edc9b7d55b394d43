// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tools/bench/accuracy/cases.h"
#include "tools/bench/options.h"
#include "tools/bench/rows.h"

namespace throng::bench {

/// Plays the case with each engine at each of its settings: a row each, of which `ms` is per simulated
/// second and `error` holds "error" ("what" in words; null where the engine can't play it, and "note" says
/// why), "dt" (s), the "setting" of the engine's knob, and "peer" where it is somebody else's. The error is
/// that of one run that is looked at; the times are those of further runs of the same setting, interleaved
/// with all others, each of which must end in the same bits.
std::vector<Row> race(const AccuracyCase& one, const Options& options);

}  // namespace throng::bench
