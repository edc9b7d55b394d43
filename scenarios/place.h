// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "scenarios/read.h"

namespace throng::scenarios {

/// Fills scene.bodies from the entries, whose settings, materials, shapes and walls the scene already has:
/// radii, angles, velocities and positions. What is random depends on the seed and the body's id alone,
/// positions also on the bodies that stand already. Reports bodies outside the domain and entries for which
/// there is no room.
void place_bodies(std::span<const Entry> entries, std::span<const ShapeDraw> draws, Scene& scene,
                  Report& report);

}  // namespace throng::scenarios
