// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "narrowphase/bvh_traverse.h"
#include "narrowphase/distance.h"

namespace throng::narrowphase {

/// A solid that is the union of many convex parts, in a hierarchy. One Convex is a solid of one part.
struct PartsBvh {
  std::span<const Convex> parts;  ///< the caller's, and must live as long
  Bvh<Box<2>> tree;
};

/// Expects one part or more. O(n log n).
PartsBvh parts_bvh(std::span<const Convex> parts, const BvhConfig& config = {});

/// What `separation` of nearest_parts.h says, to the bit: of the two parts that are nearest to each other or
/// deepest in each other, of several the first in order. Time grows with the parts about as near as these;
/// allocates nothing.
Separation separation(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                      BvhCounters* counters = nullptr);

}  // namespace throng::narrowphase
