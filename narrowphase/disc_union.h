// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "narrowphase/polygon.h"

namespace throng::narrowphase {

struct Disc {
  Vec centre;     ///< m
  double radius;  ///< m, > 0
};

/// Of all that one disc or more covers, overlaps counted once: exact but for rounding (about 1e-14), by
/// Green's theorem over the arcs that no other disc covers. Equal discs count once; the same bits on every
/// machine. O(k² log k).
MassProperties mass_properties(std::span<const Disc> discs);

}  // namespace throng::narrowphase
