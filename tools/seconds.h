// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace throng::tools {

/// How many seconds it is long.
inline double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace throng::tools
