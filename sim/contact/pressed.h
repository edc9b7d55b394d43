// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/colliders.h"
#include "sim/state.h"

namespace throng {

/// Sets `pressed` of each body to 1 where a contact pressed it in the step that ended with `state`, else to
/// 0. O(contacts).
void find_pressed(const State& state, const Colliders& colliders, std::vector<std::uint8_t>& pressed);

/// Whether two bodies were. O(contacts).
bool are_pressed(const State& state, const Colliders& colliders, std::uint32_t one, std::uint32_t two);

}  // namespace throng
