// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sim/scene.h"

namespace throng {

/// A point at which a body pressed on another or on an obstacle in a step; of engine event_driven a collision
/// within the step. With engine native the impulse is all that acted there in the step where `record.fields`
/// has contacts and bodies are rigid; else that of the last substep, times their number, of those that press
/// at the end alone. With box2d it is what those did in its step.
struct ContactRow {
  std::uint32_t a = 0, b = 0;  ///< ids of the bodies; b is 0 for a wall, a border or a static body
  double impulse = 0.0;        ///< N s, along the normal, in the whole step, or of the collision
  Vec point{0.0, 0.0};         ///< m
  bool presses = true;         ///< at the end of the step, too; isn't recorded

  friend bool operator==(const ContactRow& one, const ContactRow& other) {
    return one.a == other.a && one.b == other.b && one.impulse == other.impulse && one.point == other.point;
  }
};

}  // namespace throng
