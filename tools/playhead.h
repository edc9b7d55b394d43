// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace throng::tools {

/// Where in a recording a player is. `now` is in s of any clock that goes on, times are in s of the
/// recording, from its beginning to `end`.
class Playhead {
 public:
  static constexpr double kSlowest = 1e-9, kFastest = 1e9;  ///< times as fast as it happened

  Playhead(double end, double speed, double now) : end_(end), speed_(speed), since_(now) {}

  double time(double now) const {
    return paused_ ? time_ : std::min(end_, time_ + speed_ * std::max(0.0, now - since_));
  }
  /// When that time comes, as the clock has it. Expects not to be paused.
  double when(double time) const { return since_ + (time - time_) / speed_; }

  bool paused() const { return paused_; }
  double speed() const { return speed_; }

  void pause_or_go_on(double now) {
    go_to(time(now), now);
    paused_ = !paused_;
  }
  void go_to(double time, double now) {
    time_ = std::clamp(time, 0.0, end_);
    since_ = now;
  }
  /// As many times as fast as until now, as far as that goes.
  void speed_up(double factor, double now) {
    go_to(time(now), now);
    speed_ = std::clamp(factor * speed_, kSlowest, kFastest);
  }

 private:
  double end_, speed_, since_;
  double time_ = 0.0;
  bool paused_ = false;
};

}  // namespace throng::tools
