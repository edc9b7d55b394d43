// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/scene.h"

namespace throng::scenarios {

/// A line of points out of a well-known text.
struct WktLine {
  std::vector<Vec> points;  ///< m; without the last one where that repeats the first
  bool closed = false;      ///< a ring, or a line that ends where it began
};

struct Wkt {
  std::vector<WktLine> lines;
  std::string refusal;  ///< what is wrong and at which character; empty where all is well
};

/// What a text may hold.
enum class WktKind { any, polygons };

/// Reads LINESTRING, LINEARRING, POLYGON, MULTILINESTRING and MULTIPOLYGON in two dimensions (OGC 06-103r4,
/// section 7) into their lines and rings, in order. What geometry they make is not looked at. O(n), no
/// recursion. Of polygons: POLYGON and MULTIPOLYGON alone.
Wkt read_wkt(std::string_view text, WktKind kind = WktKind::any);

}  // namespace throng::scenarios
