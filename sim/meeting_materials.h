// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "sim/scene.h"

namespace throng {

/// Rows of materials whose surfaces may meet: that of a dynamic body, and that of a body, a wall or the box.
/// O(bodies + materials squared).
std::vector<std::pair<std::size_t, std::size_t>> meeting_materials(const Scene& scene);

}  // namespace throng
