// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "narrowphase/bvh_traverse.h"
#include "narrowphase/tracker.h"

namespace throng::narrowphase {

/// A solid that is the union of many convex parts, in a hierarchy. One Convex is a solid of one part.
struct PartsBvh {
  std::span<const Convex> parts;  ///< the caller's, and must live as long
  Bvh<BoxAndBall<2>> tree;
};

/// Expects one part or more. O(n log n). With more parts a leaf than one its hulls are fewer, its answers
/// slower.
PartsBvh parts_bvh(std::span<const Convex> parts, const BvhConfig& config = {Split::sah, 1});

/// What `separation` of nearest_parts.h says, to the bit: of the two parts that are nearest to each other or
/// deepest in each other, of several the first in order. Time grows with the parts about as near as these;
/// allocates nothing.
Separation separation(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                      BvhCounters* counters = nullptr);

/// A distance that need not be exact. Apart, the true one is at least `lower`, which is above 0, and at most
/// separation.distance, which is at most (1 + the accepted relative error) lower. Overlapping, lower is
/// separation.distance, as exact as ever.
struct RoughSeparation {
  Separation separation;
  double lower;  ///< m
};

/// With an accepted relative error of 0, what `separation` says. Takes less time the larger the accepted
/// error. Swapping a and b may give another answer that is as good.
RoughSeparation rough_separation(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                                 double relative_error, BvhCounters* counters = nullptr);

/// Where the answer about a pair of bodies was: keep one for each, in one order of a and b, and pass it
/// again. Any value is right, a near one is fast.
struct PartsMemory {
  struct Features {
    std::uint32_t a = 0, b = 0;  ///< parts
    ClosestFeatures features;
  };
  std::uint32_t a = 0, b = 0;           ///< the parts that were nearest
  std::array<Features, 64> features{};  ///< a place for several pairs of parts: the last one has it
};

/// The same for bodies that move a little between questions: begins with the parts that were nearest, and
/// goes on where each pair of parts had its closest features (Ehmann and Lin 2001), by `track`: within the
/// same error, of several nearest any. `statistics`, where given, is added to.
Separation track(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                 PartsMemory& memory, BvhCounters* counters = nullptr,
                 SearchStatistics* statistics = nullptr);

}  // namespace throng::narrowphase
