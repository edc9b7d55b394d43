// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/motion/bisect.h"

/// "Is the path free?" for rigid bodies, each a solid: a union of convex parts, or an outline with any
/// volume; the two of a pair are of one kind, of which `decompose` makes parts of an outline with its holes.
/// A static environment is one solid over all obstacles' parts that doesn't move: the answer names the part.
namespace throng::narrowphase {

template <class Shape = PartsBvh>
struct MovingSolid {
  const Shape* shape;  ///< the caller's
  Motion motion;
};

/// Two solids that move for `duration` (s), on a segment of a path.
template <class Shape = PartsBvh>
struct SolidPair {
  MovingSolid<Shape> a, b;
  double duration;
  std::uint32_t segment = 0;  ///< best without holes in their numbers
};

/// The clearance that isn't worth proving, far above rounding: 2^-34 of the radius about its origin of the
/// smaller that has one, and 2^-43 of the lengths and ways that coordinates are made of. m.
template <class Shape>
double resolution(const SolidPair<Shape>& pair);

/// Whether the two stay apart from 0 to `duration` (s), both included. The same for a and b swapped, or time
/// reversed, up to rounding. About 150 ns where they are too far from each other to meet, and as much for
/// each evaluation of small solids. Allocates its scratch; with one that is passed, only to grow.
template <class Shape>
PathAnswer check_motion(const Shape& a, const Motion& motion_a, const Shape& b, const Motion& motion_b,
                        double duration, const BisectOptions& options = {});
template <class Shape>
PathAnswer check_motion(const Shape& a, const Motion& motion_a, const Shape& b, const Motion& motion_b,
                        double duration, const BisectOptions& options, BisectScratch& scratch);

/// Of many pairs, in one queue: until the first hit found, see `bisect`. Answers name the pair by its place.
template <class Shape>
PathAnswer check_motions(std::span<const SolidPair<Shape>> pairs, const BisectOptions& options,
                         BisectScratch& scratch);

/// Of many pairs, segment by segment: `answers` has one for each, see `bisect_all`. With a segment a pair,
/// every pair is answered.
template <class Shape>
PathAnswer check_motions(std::span<const SolidPair<Shape>> pairs, const BisectOptions& options,
                         BisectScratch& scratch, std::span<PathAnswer> answers);

}  // namespace throng::narrowphase
