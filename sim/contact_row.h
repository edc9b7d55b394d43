// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sim/scene.h"

namespace throng {

/// A point at which a body pressed on another or on an obstacle at the end of a step; of engine event_driven
/// a collision within the step. What native's contacts press in a step is taken for as much in each of its
/// substeps as in the last; what bounces isn't in it.
struct ContactRow {
  std::uint32_t a = 0, b = 0;  ///< ids of the bodies; b is 0 for a wall, a border or a static body
  double impulse = 0.0;        ///< N s, along the normal, in the whole step, or of the collision
  Vec point{0.0, 0.0};         ///< m

  friend bool operator==(const ContactRow&, const ContactRow&) = default;
};

}  // namespace throng
