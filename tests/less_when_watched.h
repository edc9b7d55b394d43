// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace throng {

#ifdef NDEBUG
inline constexpr bool kWatched = false;
#else
inline constexpr bool kWatched = true;  ///< by asserts and sanitizers, at every step of a slow definition
#endif

/// So many trials or points, a fifth of them where they are watched.
constexpr std::size_t less_when_watched(std::size_t usual) {
  return kWatched ? usual / 5 : usual;
}

/// Of a list's: each of them, each fifth where they are watched.
inline constexpr std::size_t kStride = kWatched ? 5 : 1;

}  // namespace throng
