// SPDX-License-Identifier: MIT
#pragma once

#include "tools/pair_query.h"

namespace throng::tools {

/// What design.md has `throng pairs` answer. Of solids of several parts that overlap, "upper" is minus the
/// depth of the deepest part and "lower" minus the shortest way out along their faces' normals. Throws
/// InputError where a figure is no finite double. O(n + m) for convex shapes, O((n + m)²) for the way out.
/// With `work` the answer says what the distance took: pairs of volumes and of leaves compared, microseconds.
nlohmann::ordered_json answer(const PairQuery& query, bool work = false);

}  // namespace throng::tools
