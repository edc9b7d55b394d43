// SPDX-License-Identifier: MIT
#pragma once

#include "tools/pair_query.h"

namespace throng::tools {

/// What `throng pairs --help` says. Apart, "lower" and "upper" enclose the distance, "upper" is at most
/// (1 + epsilon) "lower" and the distance of the witness points. Of solids of several parts that overlap,
/// "upper" is minus the depth of the deepest part and "lower" minus the length of "way_out": of equally
/// rounded parts the shortest out of their hulls, else the shortest of those along the parts' faces and
/// "normal" alone. Throws InputError where a figure is no finite double. O((n + m)²) for the way out, n and m
/// corners and discs of what is to be parted. With `work` the answer says what the distance took: pairs of
/// volumes and of leaves compared, microseconds; and how many looks the motion took.
nlohmann::ordered_json answer(const PairQuery& query, bool work = false);

}  // namespace throng::tools
