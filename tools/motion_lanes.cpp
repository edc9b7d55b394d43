// SPDX-License-Identifier: MIT
#include "tools/motion_lanes.h"

#include <algorithm>
#include <numeric>

namespace throng::tools {

namespace {

/// Rows of the scene's pairs that were asked at all, those with most strips first.
std::vector<std::uint32_t> busiest(const std::vector<Lane>& all) {
  std::vector<std::uint32_t> rows(all.size());
  std::iota(rows.begin(), rows.end(), 0u);
  std::erase_if(rows, [&](std::uint32_t row) { return all[row].strips.empty(); });
  std::stable_sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) {
    return all[a].strips.size() > all[b].strips.size();
  });
  return rows;
}

}  // namespace

std::vector<Lane> lanes(const MotionSystem& system, const MotionAnswer& answer, std::size_t most) {
  const auto pairs = system.scene().pairs;
  std::vector<Lane> all(pairs.size()), result;
  for (std::size_t i = 0; i < answer.segments.size(); ++i) {
    const auto start = static_cast<double>(i);
    for (const narrowphase::Neighbourhood& one : answer.segments[i].covering)
      all[one.pair].strips.push_back({start + one.from, start + one.to, start + one.time, one.proven});
    if (const double clear = answer.segments[i].clear; clear > 0.0)
      for (Lane& lane : all) lane.strips.push_back({start, start + clear, start, true});
  }
  const std::vector<std::uint32_t> rows = busiest(all);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Lane& lane = all[rows[i]];
    const auto [a, b] = system.names(pairs[rows[i]], MotionSystem::kNoPart);
    lane.label = a + " – " + b;
    if (i + 1 < most || rows.size() <= most) {
      result.push_back(std::move(lane));
      continue;
    }
    if (result.size() < most) result.push_back({std::to_string(rows.size() - i) + " more pairs", {}});
    result.back().strips.insert(result.back().strips.end(), lane.strips.begin(), lane.strips.end());
  }
  return result;
}

}  // namespace throng::tools
