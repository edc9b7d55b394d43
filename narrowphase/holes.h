// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "narrowphase/convex.h"

namespace throng::narrowphase {

/// What is to be said about one ring: 0 is the outline, k is hole k - 1.
struct RingNote {
  std::size_t ring = 0;
  std::string text;
};

/// A polygon with holes: its outline, counter-clockwise, then its holes, clockwise, all without duplicate or
/// collinear vertices; or why it can't be had.
struct CleanedRings {
  std::vector<std::vector<Vec>> rings;
  std::vector<RingNote> repairs;  ///< what was harmless and mended, a sentence each
  RingNote refusal;               ///< what can't be mended; no text if the polygon is usable
};

/// Of an outline and its holes, these either way round. Mends and refuses each ring as `clean` of polygon.h
/// does; refuses rings that cross or touch each other, a hole outside the outline and a hole in another.
/// Exact. O(n log n + n h), n vertices and h holes. Expects one ring or more.
CleanedRings clean(std::span<const std::vector<Vec>> rings);

}  // namespace throng::narrowphase
