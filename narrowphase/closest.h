// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

/// What is closest, or deepest, between two convex shapes: a vertex of one and an edge of the other.
namespace throng::narrowphase {

/// The caller of `track` keeps one for each pair, in one order of a and b; a new one begins anywhere.
struct ClosestFeatures {
  std::uint32_t vertex = 0, edge = 0;
  bool vertex_of_b = true;  ///< the edge is a's; otherwise the vertex is
  bool known = false;       ///< false: the next query begins from nothing
};

/// What queries took beyond the one vertex and edge that each of them looks at.
struct SearchStatistics {
  std::int64_t steps = 0;        ///< further features walked over: states a query = 1 + steps / queries
  std::int64_t cold_starts = 0;  ///< searches from nothing
  std::int64_t depths = 0;       ///< scans of all edges: the shapes overlap, or seem to
  std::int64_t fallbacks = 0;    ///< scans of all features, because rounding led a search astray
};

}  // namespace throng::narrowphase
