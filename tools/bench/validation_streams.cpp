// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tools/bench/validation_cases.h"

namespace throng::bench {

namespace {

/// s, the least that ten, fifty, a hundred against the stream delay its last one, each beside the fewer
/// before.
Finding delay_by_counterflow(const Trials& trials) {
  std::vector<double> last;
  for (const int against : {0, 10, 50, 100}) {
    const Walked walked = trials.walk("counterflow", {"agents[1].count=" + std::to_string(against)});
    const std::vector<double>& into = walked.crossings[0];
    if (into.size() < 100)
      return {{},
              std::to_string(into.size()) + " of 100 got through against " + std::to_string(against) +
                  " in " + std::to_string(static_cast<int>(walked.scene.time.until)) + " s",
              {{"last", last}}};
    last.push_back(into.back());
  }
  double least = kNever;
  for (std::size_t i = 1; i < last.size(); ++i) least = std::min(least, last[i] - last[i - 1]);
  return {least, "", {{"last", last}}};
}

}  // namespace

std::span<const ValidationCase> stream_cases() {
  static const ValidationCase all[] = {
      {"IMO 8, NIST 2.8: counterflow", "least delay of the last of 100 by 10, 50, 100 against them", "s",
       0.02, kNever, delay_by_counterflow},
  };
  return all;
}

}  // namespace throng::bench
