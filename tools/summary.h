// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/simulation.h"

namespace throng::tools {

/// How long a run's steps took.
class RunTimes {
 public:
  void begin_step() { step_begin_ = Clock::now(); }
  void end_step();

  std::int64_t steps() const { return steps_; }
  double wall() const;       ///< s, since this was made
  double mean() const;       ///< s a step
  double mean_last() const;  ///< s a step, of the last 100

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now(), step_begin_;
  double sum_ = 0.0;
  std::int64_t steps_ = 0;
  std::deque<double> last_;
};

/// The object that `throng run` prints, with the keys of design.md.
nlohmann::ordered_json summary(const Scene& scene, const Simulation& simulation, const RunTimes& times,
                               const std::string& output);

/// Prints an object on stdout, whatever bytes its texts hold.
void print(const nlohmann::ordered_json& object);

}  // namespace throng::tools
