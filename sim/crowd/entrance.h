// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "sim/crowd/barriers.h"
#include "sim/scene.h"
#include "sim/state.h"

/// Agents who appear in the course of time.
namespace throng {

/// A place (m) in the entrance that `suits`, where the agent overlaps nobody who is there and no barrier, at
/// random by (seed, step, id); none where so many tries as kEntranceTries in the entrance's box don't find
/// one. O(agents).
std::optional<Vec> free_place(const Scene& scene, const Barriers& barriers, const State& state,
                              const Entrance& entrance, std::uint32_t agent,
                              const std::function<bool(const Vec&)>& suits);
inline constexpr int kEntranceTries = 100;

/// The agent stands there from this step on.
void add_agent(State& state, std::uint32_t agent, const Vec& place);

}  // namespace throng
