// SPDX-License-Identifier: MIT
#include "tools/bench/bvh_case.h"

#include <algorithm>
#include <cstdio>

namespace throng::bench {

std::string text(double value) {
  char result[32];
  std::snprintf(result, sizeof result, "%.9g", value);
  return result;
}

void Case::add(std::string engine, std::function<double()> ask, nlohmann::ordered_json error) {
  constexpr double kBlockSeconds = 0.002;
  sums_.push_back(ask());
  errors_.push_back(std::move(error));
  const auto begin = std::chrono::steady_clock::now();
  ask();
  const std::chrono::duration<double> once = std::chrono::steady_clock::now() - begin;
  repeats_.push_back(std::clamp(static_cast<int>(kBlockSeconds / (once.count() + 1e-9)), 1, 10000));
  contestants_.push_back({std::move(engine), [ask = std::move(ask), repeats = repeats_.back()] {
                            for (int i = 0; i < repeats; ++i) ask();
                          }});
}

void Case::finish(const Options& options, std::vector<Row>& rows) {
  interleave(contestants_, options.blocks, work_);
  for (std::size_t i = 0; i < contestants_.size(); ++i) {
    Contestant& one = contestants_[i];
    for (double& ms : one.ms) ms /= repeats_[i];
    errors_[i]["ns"] = 1e6 * median(one.ms);
    rows.push_back({"bvh", name_, one.engine, 1, one.ms, work_, text(sums_[i]), errors_[i]});
  }
}

}  // namespace throng::bench
