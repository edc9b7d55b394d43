// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace throng::broadphase {

using LanesOfMasks = std::array<std::array<std::uint32_t, 8>, 256>;

constexpr LanesOfMasks lanes_of_masks() {
  LanesOfMasks table{};
  for (std::uint32_t mask = 0; mask < 256; ++mask)
    for (std::uint32_t lane = 0, count = 0; lane < 8; ++lane)
      if (mask >> lane & 1) table[mask][count++] = lane;
  return table;
}

/// For each mask of eight lanes its lanes, ascending. (Where vectors can't be compressed by one instruction,
/// Highway 1.0.3 does it by a table that it copies to the stack each time, 1 or 2 kB.)
inline constexpr LanesOfMasks kLanesOfMask = lanes_of_masks();

}  // namespace throng::broadphase
