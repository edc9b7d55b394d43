// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/probe.h"

/// How `separation` and `track` come to an answer that proves itself.
namespace throng::narrowphase {

/// Goes on from features that `look` has seen and that prove nothing, each step to closer ones, until they
/// do. False where the walk ends in an overlap, or what looks like one, or takes too long; `features` and
/// `look` are then where it gave up.
bool walk(const Placed& placed, Look& look, ClosestFeatures& features, SearchStatistics& statistics);

/// From nothing, leaving the features found. Expects no two discs. `overlap_likely`: look for a depth first.
Separation search(const Placed& placed, bool overlap_likely, ClosestFeatures& features,
                  SearchStatistics& statistics);

}  // namespace throng::narrowphase
