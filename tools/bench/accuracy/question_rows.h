// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tools/bench/options.h"
#include "tools/bench/rows.h"

namespace throng::bench {

/// The narrowphase as scenes of the laboratory: times are of a thousand questions, and there is no dt, but
/// null.
///
/// * "when do octagons meet": of `throng bench motion`; error: how far apart, or deep in each other, two are
///   at the worst first contact that was told, of their size. Of samples `setting` says how far apart they
///   are.
/// * "how far apart are octagons": of `throng bench narrowphase`; error: the worst distance, of their scale.
/// * "distances to a tolerance": of `throng bench bvh`; error: the worst distance, relative.
std::vector<Row> question_rows(const Options& options);

}  // namespace throng::bench
