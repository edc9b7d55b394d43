// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/exact_row.h"

#include <algorithm>

namespace throng::bench {

std::vector<BodyState> exact_row(std::span<const BodyState> start, double diameter, double t) {
  std::vector<BodyState> lines(start.begin(), start.end());
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i].position.x() += t * lines[i].velocity.x() - static_cast<double>(i) * diameter;
  std::ranges::stable_sort(lines, {}, [](const BodyState& line) { return line.position.x(); });
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i].position.x() += static_cast<double>(i) * diameter;
  return lines;
}

}  // namespace throng::bench
