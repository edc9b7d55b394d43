// SPDX-License-Identifier: MIT
#pragma once

namespace throng {

/// Of how agents walk.
inline const char* const kModels[] = {"constant_velocity", "social_force", "collision_free_speed", "orca"};

}  // namespace throng
