// SPDX-License-Identifier: MIT
#pragma once

namespace throng {

/// Asks for memory that will be read. (Calls of a function that does nothing else g++ 12 leaves out, as if it
/// were pure.)
inline void prefetch(const void* place) {
  __builtin_prefetch(place);
  asm volatile("");
}

}  // namespace throng
