// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sim/scene.h"

namespace throng {

/// Rows of materials whose surfaces may meet: that of a dynamic body, and that of a body, a wall or the box.
/// O(bodies + materials squared).
std::vector<std::pair<std::size_t, std::size_t>> meeting_materials(const Scene& scene);

/// "materials.tar.rolling_resistance: " and `why`, where surfaces that may meet resist rolling; "" where none
/// do.
std::string rolling_refusal(const Scene& scene, const std::string& why);

}  // namespace throng
