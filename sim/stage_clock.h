// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace throng {

/// Measures the time from lap to lap.
class StageClock {
 public:
  /// Of a step that stands for so many; for none: nothing is measured, and no clock is read.
  explicit StageClock(int steps = 1) : steps_(steps) {
    if (steps_ > 0) last_ = std::chrono::steady_clock::now();
  }

  /// Adds to `total` (s) what has passed since the last lap, or since the clock was made.
  void lap(double& total) {
    if (steps_ == 0) return;
    const auto now = std::chrono::steady_clock::now();
    total += steps_ * std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  int steps_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace throng
