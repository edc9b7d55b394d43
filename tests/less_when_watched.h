// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace throng {

/// So many trials or points; a fifth of them where asserts and sanitizers watch every step of a slow
/// definition.
constexpr std::size_t less_when_watched(std::size_t usual) {
#ifdef NDEBUG
  return usual;
#else
  return usual / 5;
#endif
}

}  // namespace throng
