// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <string>

namespace throng {

/// Whether long tests run whole: THRONG_FULL=1 in the environment.
inline bool full_length() {
  const char* full = std::getenv("THRONG_FULL");
  return full && std::string(full) == "1";
}

}  // namespace throng
