// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/motion/bisect.h"

/// "Is the path free?" for rigid bodies, each a solid of convex parts. A static environment is one solid over
/// all obstacles' parts that doesn't move: the answer names the part.
namespace throng::narrowphase {

struct MovingSolid {
  const PartsBvh* shape;  ///< the caller's
  Motion motion;
};

/// Two solids that move for `duration` (s), on a segment of a path.
struct MovingPair {
  MovingSolid a, b;
  double duration;
  std::uint32_t segment = 0;  ///< fewer than 2^32, best without holes
};

/// What clearance of two solids can be told from contact, here a multiple: 2^-34 of the radius about its
/// origin of the smaller that has one, and 2^-43 of how far coordinates go, relative to each other or turned.
/// m.
double resolution(const MovingPair& pair);

/// Whether the two stay apart from 0 to `duration` (s), both included. Swapping a and b gives the same but
/// for which part of equals is told. About 200 ns for a far pair, and as much for each of the answer's
/// evaluations of small solids. Allocates its scratch; with one that is passed, only to grow.
PathAnswer check_motion(const PartsBvh& a, const Motion& motion_a, const PartsBvh& b, const Motion& motion_b,
                        double duration, const BisectOptions& options = {});
PathAnswer check_motion(const PartsBvh& a, const Motion& motion_a, const PartsBvh& b, const Motion& motion_b,
                        double duration, const BisectOptions& options, BisectScratch& scratch);

/// Of many pairs, in one queue: until the first hit found, see `bisect`. Answers name the pair by its place.
PathAnswer check_motions(std::span<const MovingPair> pairs, const BisectOptions& options,
                         BisectScratch& scratch);

/// Of many pairs, segment by segment: `answers` has one for each, see `bisect_all`. With a segment a pair,
/// every pair is answered.
PathAnswer check_motions(std::span<const MovingPair> pairs, const BisectOptions& options,
                         BisectScratch& scratch, std::span<PathAnswer> answers);

}  // namespace throng::narrowphase
