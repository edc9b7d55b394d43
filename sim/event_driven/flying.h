// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sim/scene.h"

namespace throng {

/// A hard disc since its last collision, in one cache line.
struct alignas(64) Flying {
  Vec position;            ///< m, then; moved by a period where it leaves a domain that repeats
  Vec velocity;            ///< m/s, then
  double since;            ///< s
  double radius;           ///< m
  double spin;             ///< rad/s
  std::uint32_t had = 0;   ///< collisions
  std::uint32_t body = 0;  ///< its row in the scene
};
static_assert(sizeof(Flying) == 64);

}  // namespace throng
