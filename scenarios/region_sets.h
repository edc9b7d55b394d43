// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/crowd/region.h"

/// Regions as sets of points. Expects rings that `polygon_fault` finds sound, or that touch
/// themselves.
namespace throng::scenarios {

/// m², of what two regions have in common.
double common_area(const Region& a, const Region& b);

/// Whether any of the line between two different points is inside the region, not only on its border.
bool runs_through(const Vec& from, const Vec& to, const Region& region);

/// What is in any of them.
Region united(std::span<const Region> regions);

/// What two regions have in common.
Region common(const Region& a, const Region& b);

/// What is in the one and not in the other.
Region without(const Region& region, const Region& other);

/// What is at most `half` (m) to the left and the right of a line of different points.
Region band(std::span<const Vec> line, double half);

}  // namespace throng::scenarios
