// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scenarios/wkt.h"

namespace throng::scenarios {

/// What is wrong with a POLYGON or MULTIPOLYGON (rings that cross, holes outside, an inside that falls
/// apart), and at which coordinate; "" where it is sound. GEOS decides, by the rules of OGC 06-103r4. Expects
/// a text that `read_wkt` takes.
std::string polygon_fault(const std::string& wkt);

/// The ring as a well-known text, exact to the last bit.
std::string polygon_wkt(const std::vector<Vec>& ring);

}  // namespace throng::scenarios
