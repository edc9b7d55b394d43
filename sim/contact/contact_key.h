// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "broadphase/pairs.h"

/// Under which number the impulses of a contact are kept: its two colliders, or a collider and an obstacle.
/// Those of obstacles come after those of pairs.
namespace throng {

constexpr std::uint64_t kObstacleKey = std::uint64_t{1} << 63;

inline std::uint64_t key_of(broadphase::Pair pair, bool obstacle) {
  return (obstacle ? kObstacleKey : 0) | std::uint64_t{pair.a} << 32 | pair.b;
}

inline bool is_of_obstacle(std::uint64_t key) {
  return (key & kObstacleKey) != 0;
}

/// The rows that key_of() was given.
inline broadphase::Pair pair_of(std::uint64_t key) {
  return {static_cast<std::uint32_t>((key & ~kObstacleKey) >> 32), static_cast<std::uint32_t>(key)};
}

}  // namespace throng
