// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

namespace throng {

/// Measures the time from lap to lap.
class StageClock {
 public:
  /// Of a step that stands for so many; for none: nothing is measured, and no clock is read.
  explicit StageClock(int steps = 1) : steps_(steps) {
    if (steps_ > 0) begin_ = last_ = std::chrono::steady_clock::now();
  }

  /// Adds to `total` (s) what has passed since the last lap, or since the clock was made.
  void lap(double& total) {
    if (steps_ == 0) return;
    const auto now = std::chrono::steady_clock::now();
    total += steps_ * std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

  /// s, from when the clock was made to the last lap; 0 where nothing is measured.
  double measured() const { return std::chrono::duration<double>(last_ - begin_).count(); }

 private:
  int steps_;
  std::chrono::steady_clock::time_point begin_, last_;
};

/// Which steps are measured where to read the clock may take as long as a stage: of short ones, but for the
/// first few, one of ever more, that stands for those before it that weren't measured.
class StepSampling {
 public:
  /// For how many steps the times of the next one stand, in all never for more than there were; 0: it isn't
  /// measured.
  int next() {
    const std::int64_t most = std::min(kMostUnmeasured, steps_++ / kFirst);
    if (last_ < kShort && unmeasured_ < most) {
      ++unmeasured_;
      return 0;
    }
    return static_cast<int>(std::exchange(unmeasured_, 0)) + 1;
  }

  /// How long that step took, s: StageClock::measured().
  void took(double seconds) { last_ = seconds; }

  std::int64_t steps() const { return steps_; }

 private:
  static constexpr double kShort = 5e-6;  // s: a step's laps take some 0.2e-6
  static constexpr std::int64_t kFirst = 4, kMostUnmeasured = 31;

  std::int64_t steps_ = 0, unmeasured_ = 0;
  double last_ = 0.0;
};

}  // namespace throng
