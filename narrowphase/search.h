// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/probe.h"

/// How `separation` and `track` come to an answer that proves itself.
namespace throng::narrowphase {

/// From nothing, leaving the features found. Expects no two discs. `overlap_likely`: look for a depth first.
Separation search(const Placed& placed, bool overlap_likely, ClosestFeatures& features,
                  SearchStatistics& statistics);

}  // namespace throng::narrowphase
