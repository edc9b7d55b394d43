// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "narrowphase/bvh_outline.h"
#include "narrowphase/bvh_parts.h"
#include "narrowphase/motion/clear_time.h"
#include "narrowphase/motion/motion.h"

/// How long two moving solids, standing somewhere at an instant, stay apart: what distances and bounds of
/// movement prove. The ground of "is the path free?" (bisect.h) and of sequential advancement.
namespace throng::narrowphase {

/// Around an instant: nothing touches from `before` earlier to `after` later, both included.
struct SafeTime {
  double before = 0.0, after = 0.0;      ///< s, never negative: 0 where it is a matter of rounding
  bool hit = false;                      ///< the two touch or overlap at the instant, as `separation` says
  std::uint32_t part_a = 0, part_b = 0;  ///< of each solid the part that limits the time, or is hit
};

/// How much is wanted, and how exactly.
struct SafeTimeQuestion {
  double before = std::numeric_limits<double>::infinity();  ///< s, no more is needed
  double after = std::numeric_limits<double>::infinity();   ///< s
  double pose_error = 0.0;  ///< m, how far rounding may have put the two, summed; see `pose_rounding`
  const RelativeMotion* motion = nullptr;  ///< where it is known, `clear_time` makes the answer longer
  double relative_error = 0.0;  ///< e: below the time wanted, 1 / (1 + e) of the truth may be the answer
};

/// The least over all pairs of parts of the longest of three bounds: d / mu, d being their distance and mu =
/// rate.of(...) with each part's own radius about its origin (Schwarzer, Saha and Latombe 2005, sharpened by
/// the hierarchy); how long the origins stay so far apart that the two don't reach each other however they
/// turn; and, where the motion is known, `clear_time`. Of nodes the last two stand for all their parts. Never
/// more than the truth, rounding included; where nothing moves, infinite. Obstacles so far that the time
/// wanted is safe cost one comparison. Time grows with the parts that limit it about as much as the first;
/// allocates nothing.
SafeTime safe_time(const PartsBvh& a, const Pose& pose_a, const PartsBvh& b, const Pose& pose_b,
                   const GapRate& rate, const SafeTimeQuestion& question, BvhCounters* counters = nullptr);

/// The same of two outlines: edges are the parts, a hit is what `collide` says, also where one solid lies in
/// the other.
template <class Volume>
SafeTime safe_time(const Outline<Volume>& a, const Pose& pose_a, const Outline<Volume>& b, const Pose& pose_b,
                   const GapRate& rate, const SafeTimeQuestion& question, BvhCounters* counters = nullptr);

}  // namespace throng::narrowphase
