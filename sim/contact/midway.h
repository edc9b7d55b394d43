// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "narrowphase/manifold.h"
#include "sim/contact/look_ahead.h"
#include "sim/contact/stumbles.h"
#include "sim/contact/touch.h"
#include "sim/workers.h"

namespace throng {

/// A step of `dt` (s), and what has been found of its touches.
struct FoundTouches {
  double dt;
  const StepStart& start;
  std::span<const Touch> touches;
  const LookAhead& ahead;
  const Stumbles& stumbles;
};

/// Describes discs that slide along walls that bend, in pieces that hardly turn (narrowphase/rim.h), as they
/// touch where they are in the step's middle: normals of its beginning lag behind by half a step, which in a
/// hollow of radius R gives g dt / (2 R) of the energy a second. Replaces these manifolds and the numbers of
/// their points; distances are those of the step's beginning.
///
/// Of a disc that gets no farther than a quarter of its radius to the middle; all that it touches within the
/// step faces one way to 0.02 rad, at either time, and none of it is met fast, or is a stumble. O(touches of
/// walls).
void touch_midway(const FoundTouches& found, std::span<narrowphase::Manifold> manifolds,
                  std::span<std::uint8_t> points, Workers& workers);

}  // namespace throng
