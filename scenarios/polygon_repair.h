// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/crowd/region.h"

namespace throng::scenarios {

/// What a POLYGON or MULTIPOLYGON means that `polygon_fault` finds fault with: all that is in an outer ring
/// and in none of its holes. So holes may overlap, touch or reach out, polygons may overlap, rings may touch
/// themselves. Empty where none of that is the fault: a ring crosses itself, a hole takes nothing away, or
/// nothing is left.
Region repaired_polygon(const std::string& wkt);

}  // namespace throng::scenarios
