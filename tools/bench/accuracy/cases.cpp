// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/cases.h"

namespace throng::bench {

std::vector<double> halvings(double longest, int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(longest / (1 << i));
  return all;
}

JudgeMaker by_trajectory(Truth truth, double every, bool turns) {
  return [truth, every, turns](const Scene& scene) { return trajectory_judge(scene, truth, every, turns); };
}

}  // namespace throng::bench
