// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/record.h"

namespace throng::recording {

/// Which frames hold what is recorded each so many steps, and as which of its samples.
class Schedule {
 public:
  Schedule() = default;  ///< never

  /// O(frames); allocates where not all frames hold it.
  Schedule(int every, std::span<const std::int64_t> steps) : every_(every), samples_(steps.size()) {
    std::vector<std::uint32_t> sample;
    std::uint32_t next = 0;
    for (std::int64_t step : steps) sample.push_back(is_due(every, step) ? next++ : kNone);
    if (next == steps.size()) return;
    samples_ = next;
    sample_ = std::move(sample);
  }

  /// What is in the frames of these steps, ascending: samples up to the first step that no frame has.
  Schedule(std::span<const std::int64_t> listed, std::span<const std::int64_t> steps) : every_(1) {
    for (std::int64_t step : steps)
      sample_.push_back(samples_ < listed.size() && listed[samples_] == step
                            ? static_cast<std::uint32_t>(samples_++)
                            : kNone);
  }

  int every() const { return every_; }              ///< steps; 0: never; 1 where they are listed
  std::size_t samples() const { return samples_; }  ///< in all frames
  std::optional<std::size_t> sample(std::size_t frame) const {
    if (every_ == 0) return std::nullopt;
    if (sample_.empty()) return frame;
    return sample_[frame] == kNone ? std::nullopt : std::optional<std::size_t>(sample_[frame]);
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  int every_ = 0;
  std::size_t samples_ = 0;
  std::vector<std::uint32_t> sample_;  // by frame; empty where each is a sample
};

}  // namespace throng::recording
