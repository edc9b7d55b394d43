// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// A polygon with holes as one closed line, its inside on the left: it runs to each hole, round it and back
/// the same way, so that the ends of these bridges stand in it twice or more. Bridges meet nothing but at
/// their ends. Expects rings as `clean` of holes.h gives them. Exact; O(n h), n vertices and h holes;
/// allocates.
std::vector<Vec> bridged(std::span<const std::vector<Vec>> rings);

}  // namespace throng::narrowphase
