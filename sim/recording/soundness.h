// SPDX-License-Identifier: MIT
#pragma once

#include "sim/state.h"

namespace throng::recording {

/// Whether a run could have come to that state: names, numbers that are finite and not absurd, contacts in
/// order. Whether it has the rows that a scene asks for is for `fits` to say. O(n log n).
bool is_sound(const State& state);

}  // namespace throng::recording
