// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "broadphase/pairs.h"
#include "sim/scene.h"

/// Which of many pairs of discs that fly straight may meet within a step? A glance at all of them, in lanes;
/// few are left, and `narrowphase::disc_flight` says when those meet.
namespace throng {

/// How a disc flies, in half a cache line.
struct alignas(32) StraightWay {
  Vec position;  ///< m
  Vec velocity;  ///< m/s
};

constexpr std::size_t kMeetingsWide = 8;  ///< pairs of which one number tells

/// What is asked of pairs of discs.
struct MeetingsAsked {
  std::span<const StraightWay> discs;
  std::span<const broadphase::Pair> pairs;  ///< rows of `discs`
  std::span<const double> reach;            ///< m, of each pair the sum of the radii
  const Vec* period;                        ///< m, where the domain repeats, else null
  double until;                             ///< s
};

/// Writes bit k of found[i], from block `begin` to `end`, for pair i * kMeetingsWide + k: 1 where
/// `narrowphase::disc_flight` finds a time, or a gap below 0, and hardly anywhere else; of no pair 0.
/// Elementwise, so the same for each width.
void find_meetings(const MeetingsAsked& asked, std::size_t begin, std::size_t end, std::uint8_t* found);

}  // namespace throng
