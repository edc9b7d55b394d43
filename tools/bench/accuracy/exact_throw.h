// SPDX-License-Identifier: MIT
#pragma once

#include "tools/bench/accuracy/body_state.h"

namespace throng::bench {

/// A body that nothing touches, after t (s): x + v t + g t² / 2, angle + spin t (Galilei 1638).
BodyState exact_throw(const BodyState& start, const Vec& gravity, double t);

}  // namespace throng::bench
