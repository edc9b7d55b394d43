// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/scene.h"

namespace throng::tools {

/// A part of the plane (m) to be shown.
struct Extent {
  Vec min{0.0, 0.0}, max{1.0, 1.0};
  Vec size() const { return max - min; }
};

/// What a picture of bodies at `positions` should show: all of a bounded domain where they are spread over
/// it, all of the floor that agents walk on, else the bodies and the walls near them, tightly; a few bodies
/// far from all others don't count. Never empty.
Extent framing(const Scene& scene, std::span<const Vec> positions);

}  // namespace throng::tools
