// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace throng::tools {

/// How far a run or a film is, on stderr: a bar on a terminal, a plain line every few seconds elsewhere.
class Progress {
 public:
  enum class Style { bar, plain, json, none };

  /// `name` is auto, plain, json or none; auto is a bar where stderr is a terminal, else plain.
  static Style style(const std::string& name);

  /// Expects steps of dt (s) from number `first` to `steps`; `step` is what one is called.
  Progress(Style style, std::int64_t steps, double dt, std::int64_t first = 0, const char* step = "step");
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::int64_t step);  ///< cheap: looks at the clock, and seldom prints
  void finish(std::int64_t step);  ///< clears the bar, or prints the last line

 private:
  using Clock = std::chrono::steady_clock;
  void print(std::int64_t step, double elapsed);
  void clear();

  Style style_;
  std::int64_t steps_, first_;
  double dt_;
  const char* name_;
  bool shown_ = false;  // the bar
  Clock::time_point begin_ = Clock::now(), next_;
};

}  // namespace throng::tools
