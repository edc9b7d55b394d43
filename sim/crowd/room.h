// SPDX-License-Identifier: MIT
#pragma once

#include "sim/crowd/barriers.h"
#include "sim/crowd/region.h"

namespace throng {

/// Whether agents of that radius (m) get well into an area: there is room on the floor for all of one in it,
/// or for his middle, with a radius more of room between him and all barriers. Where neither is, as in a
/// strip before a wall, he would have to press himself against the wall, or couldn't get in at all. To within
/// a hundredth of the radius. O(border / radius) looks at edges and barriers.
bool has_room(const Region& area, const Region& walkable, const Barriers& barriers, double radius);

/// m, how far apart two points of the region are at most, to a thousandth. Expects a region that isn't empty.
/// O(corners).
double span(const Region& region);

/// m, of the agents up to the `widest` (m) who have room there; to within a thousandth of the widest below.
double largest_with_room(const Region& area, const Region& walkable, const Barriers& barriers, double widest);

}  // namespace throng
