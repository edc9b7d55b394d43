// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "tools/motion_system.h"

namespace throng::tools {

/// Two solids, and how far apart they are, somewhere on a path. Margins don't count.
struct MotionDistance {
  std::size_t segment = 0;
  double fraction = 0.0;
  std::string a, b;
  narrowphase::Separation separation;
};

/// The two that are nearest to each other, or deepest in each other, at a waypoint. None where nothing is
/// compared; links that their limits keep apart are. O(pairs), some 300 ns each; allocates.
std::optional<MotionDistance> nearest_at(const MotionTask& task, std::size_t waypoint);

/// How near anything that may not touch comes on a free path.
struct MotionClearance {
  double low = 0.0;        ///< m, proven: nothing comes nearer
  MotionDistance nearest;  ///< how near something comes
  std::size_t evaluations = 0;
};

/// Of a path that is free at a margin of `low` (m). Looks at the path in many places, then asks whether it is
/// free at a margin just below the least distance found, until that is proven or something nearer is found:
/// low is no less than 0.999 of the distance found, but where `epsilon` (m, see MotionQuestion) or rounding
/// leaves more in doubt: then of the least margin that was left undecided. Links that their limits keep apart
/// count too. Looks at no more than 1,025 configurations, with fewer than 1,000,000 distances or two
/// configurations, before it goes down from the nearest, 42 more each time. Mostly one to ten times the
/// computations of the question whether the path is free. None where nothing is compared. Where the pairs
/// within the distance found, times segments, are too many to be asked at once, low is as given.
std::optional<MotionClearance> least_clearance(const MotionTask& task, double low, double epsilon);

nlohmann::ordered_json to_json(const MotionDistance& distance);
nlohmann::ordered_json to_json(const MotionClearance& clearance);

}  // namespace throng::tools
