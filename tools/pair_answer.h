// SPDX-License-Identifier: MIT
#pragma once

#include "tools/pair_query.h"

namespace throng::tools {

/// What design.md has `throng pairs` answer. Of solids of several parts that overlap, "upper" is minus the
/// depth of the deepest part and "lower" minus the shortest way out along their faces' normals. Throws
/// InputError where a figure is no finite double. O(n + m) for convex shapes, O((n + m)²) for the way out.
nlohmann::ordered_json answer(const PairQuery& query);

}  // namespace throng::tools
