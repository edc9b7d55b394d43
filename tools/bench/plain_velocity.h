// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sim/crowd/permitted_velocity.h"

namespace throng::bench {

/// permitted_velocity as it is written down at first: half plane by half plane.
Vec plain_velocity(std::span<const HalfPlane> planes, std::size_t hard, double most, const Vec& preferred,
                   std::vector<HalfPlane>& room);

}  // namespace throng::bench
