// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "sim/scene.h"
#include "sim/state.h"
#include "sim/workers.h"

namespace throng {

/// From so many agents on it pays to keep their rows in the order in which they stand: what is known of fewer
/// fits into the nearest caches.
inline constexpr std::size_t kSome = 4'000;
/// From so many on it does so wherever it may, though something follows from it.
inline constexpr std::size_t kMany = 20'000;
inline constexpr std::int64_t kRowsFollow = 64;  ///< steps, after which they do so anew

/// Whether the crowd's rows are kept in the order in which agents stand: where none appear later. Where it
/// matters who has which row, of kMany alone: those who want one place take it in the order of rows, and
/// means are taken in it.
bool rows_follow(const Crowd& crowd);

/// Takes those agents out of a state, rows from `first` on, whose `leaves` isn't 0. The others keep their
/// order and move up, O(n), or the last of them fill the gaps, O(gaps) but for looking who leaves.
void remove_agents(State& state, std::size_t first, std::span<const std::uint8_t> leaves, bool in_order);

/// Moves the rows of a state's agents, which begin at `first`: row k of them is what row order[k] was.
/// Expects each of them once. O(n), and as much memory as the largest array.
void reorder_agents(State& state, std::size_t first, std::span<const std::uint32_t> order, Workers& workers);

}  // namespace throng
