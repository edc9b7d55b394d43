// SPDX-License-Identifier: MIT
#pragma once

#include "tools/pair_query.h"

namespace throng::tools {

/// What `throng pairs --help` says. Apart, "lower" and "upper" enclose the distance, "upper" is at most
/// (1 + epsilon) "lower" and the distance of the witness points. Of solids of several parts that overlap,
/// "upper" is minus the depth of the deepest part and "lower" minus the length of "way_out", the shortest way
/// out of their hulls. Throws InputError where a figure is no finite double. O((h + k)²) for the way out, h
/// and k corners of the hulls. With `work` the answer says what the distance took: pairs of volumes and of
/// leaves compared, microseconds.
nlohmann::ordered_json answer(const PairQuery& query, bool work = false);

}  // namespace throng::tools
