// SPDX-License-Identifier: MIT
#pragma once

#include "sim/crowd/barriers.h"

namespace throng {

/// Where a disc gets that is to move straight on.
struct Moved {
  Vec to{0.0, 0.0};        ///< m
  bool corrected = false;  ///< a barrier was in the way
};

/// Moves a disc of that radius (m) from `from` by `by` (m), but never into a barrier: it goes on to the first
/// contact, by its exact time, and from there along the barrier, twice at most. Who begins nearer to a
/// barrier than his radius gets no nearer to it. What arithmetic may get wrong by rounding is checked
/// afterwards, and undone: the middle never crosses a barrier, and never gets nearer to one than before or
/// than the radius less a few ulp. O(segments near). Allocates nothing.
Moved slide(const Barriers& barriers, const Vec& from, const Vec& by, double radius);

}  // namespace throng
