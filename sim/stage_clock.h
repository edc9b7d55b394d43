// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace throng {

/// Measures the time from lap to lap.
class StageClock {
 public:
  /// Adds to `total` (s) what has passed since the last lap, or since the clock was made.
  void lap(double& total) {
    const auto now = std::chrono::steady_clock::now();
    total += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace throng
