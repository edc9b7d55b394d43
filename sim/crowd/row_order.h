// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "sim/state.h"
#include "sim/workers.h"

namespace throng {

/// From so many agents on it pays to keep their rows in the order in which they stand: what is known of fewer
/// fits into the caches.
inline constexpr std::size_t kMany = 20'000;
inline constexpr std::int64_t kRowsFollow = 64;  ///< steps, after which they do so anew

/// Takes those agents out of a state, rows from `first` on, whose `leaves` isn't 0. The others keep their
/// order and move up, O(n), or the last of them fill the gaps, O(gaps) but for looking who leaves.
void remove_agents(State& state, std::size_t first, std::span<const std::uint8_t> leaves, bool in_order);

/// Moves the rows of a state's agents, which begin at `first`: row k of them is what row order[k] was.
/// Expects each of them once. O(n), and as much memory as the largest array.
void reorder_agents(State& state, std::size_t first, std::span<const std::uint32_t> order, Workers& workers);

}  // namespace throng
