// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/event_driven/flying.h"

/// Whom does a disc meet first among those near it, if nobody else turns anyone aside?
namespace throng {

/// A disc that looks round.
struct Looker {
  Vec position;          ///< m, now
  Vec velocity;          ///< m/s, now
  double radius;         ///< m
  double now;            ///< s
  std::uint32_t disc;    ///< its row
  std::uint32_t spared;  ///< row of whom it has just met, or any other that is no disc
};

struct Meeting {
  double time;          ///< s
  std::uint32_t other;  ///< row
};

/// So many more rows than there are may be written behind them.
constexpr std::size_t kMeetingPadding = 8;

/// Makes `first` the meeting with whoever of `near`, `count` rows of `discs`, it meets sooner than that; of
/// those at one time the first. Images that lie `shift` (m) from the discs are met, all of which `pull`
/// (m/s²), if any, pulls alike. What stands in `near` may be lost. Elementwise, so the same for each width.
/// O(count).
void meet(const Flying* discs, std::uint32_t* near, std::size_t count, const Vec& shift, const Vec* pull,
          const Looker& looker, Meeting& first);

}  // namespace throng
