// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "sim/state.h"

namespace throng::recording {

/// Whether a run could have come to that state: names, numbers that are finite and not absurd, contacts in
/// order. Whether it has the rows that a scene asks for is for `fits` to say. O(n log n).
bool is_sound(const State& state);

/// The ids of a run's agents: from `first` to `last`.
struct AgentIds {
  std::uint32_t first = 1, last = 0;
};

/// Whether these are steps, up to `last`, and names of agents who arrived in them: one after the other, those
/// of one step by their names, none before the first step, nobody twice. O(n log n).
bool are_arrivals(std::span<const std::int64_t> steps, std::span<const std::uint32_t> id, std::int64_t last,
                  AgentIds agents);

}  // namespace throng::recording
