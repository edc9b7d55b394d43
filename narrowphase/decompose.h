// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// A simple polygon as convex parts that cover it without overlap: at most four times as many as needed.
/// Expects what `clean` gives. Parts are strictly convex, counter-clockwise, made of the polygon's own
/// vertices; a convex polygon is its own single part. Ears are cut off by exact predicates, then diagonals
/// that no corner needs are taken out again (Hertel and Mehlhorn 1983). O(n r), r = reflex vertices; each
/// part has `radius`.
std::vector<Convex> decompose(std::span<const Vec> polygon, double radius = 0.0);

/// A polygon with holes, as `clean` of holes.h gives it, likewise: at most 2 r + 1 parts. O(n (r + h)), h
/// holes.
std::vector<Convex> decompose(std::span<const std::vector<Vec>> rings, double radius = 0.0);

}  // namespace throng::narrowphase
