// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "narrowphase/distance.h"

namespace throng::narrowphase {

/// Of two solids, each the union of its convex parts: the separation of the two parts that are nearest to
/// each other, or deepest in each other. Where solids overlap that isn't their depth, but a lower bound of
/// it. Expects at least one part each. Where several pairs are as near, the first in order. O(n m) bounds and
/// as many separations as bounds can't rule out, n and m being parts; allocates.
Separation separation(std::span<const Convex> a, const Pose& pose_a, std::span<const Convex> b,
                      const Pose& pose_b);

/// A disc that holds a part, rounding included.
struct Bound {
  Vec centre;     ///< m
  double radius;  ///< m
};

Bound bound(const Convex& part, const Pose& pose);

}  // namespace throng::narrowphase
