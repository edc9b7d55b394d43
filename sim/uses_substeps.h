// SPDX-License-Identifier: MIT
#pragma once

#include "sim/scene.h"

namespace throng {

/// Whether the number of substeps does anything in a scene: not to agents, nor to what moves beside them, nor
/// where there is no time step.
inline bool uses_substeps(const Scene& scene) {
  return scene.engine != Engine::event_driven && scene.crowd.size() == 0;
}

}  // namespace throng
