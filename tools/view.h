// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sim/recording/recording.h"
#include "tools/framing.h"

namespace throng::tools {

/// The colours' speeds: from 0 to `top`, which some bodies may be beyond.
struct SpeedScale {
  double top = 0.0;  ///< m/s, 0 where nothing moves or no velocity was recorded
  bool beyond = false;
};

/// How frames are shown.
struct View {
  Extent extent;  ///< see framing.h
  SpeedScale speeds;
};

/// How many a frame shows: "3 bodies", "40 agents", "1 body, 40 agents".
std::string who_is_there(const Bodies& bodies, const Frame& frame);

/// Throws InputError that names `file` where there is nothing to draw: no frames or no positions.
void expect_drawable(const Recording& recording, const std::string& file);

/// The view that suits one frame. O(bodies log bodies).
View view_of(const Scene& scene, const Frame& frame);

/// One view for all frames, so that nothing jumps from one to the next: what suits up to 24 of them, evenly
/// spread, together. Expects frames and recorded positions.
View view_of(const Recording& recording);

}  // namespace throng::tools
