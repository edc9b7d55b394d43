// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "broadphase/point.h"
#include "sim/scene.h"

namespace throng::tools {

/// Where bodies stand, and where they go, a row each in order of id; and what is between them.
struct CrowdSnapshot {
  std::vector<std::uint32_t> id;
  std::vector<Vec> position;  ///< m, in the period where there is one
  std::vector<Vec> velocity;  ///< m/s; empty where it was not recorded
  std::vector<double> angle;  ///< rad; likewise
  std::string no_velocity;    ///< why there are none: "were not recorded ..." or "are not in this frame ..."
  std::string no_angle;       ///< likewise
  double time = 0.0;          ///< s
  std::optional<broadphase::Period> period;
  Scene scene;                          ///< its walls and shapes
  std::vector<std::uint32_t> body;      ///< which row of its bodies each is, counted from 1
  std::vector<std::uint32_t> recorded;  ///< ids of all whom the recording may show; empty for a scenario
  std::size_t bodies_of_run = 0;        ///< whose ids go from 1 to this
};

/// The bodies of a scenario as it starts, or of the frame of a recording that is nearest to time `at` (s),
/// without it the last one. Throws InputError where there is none, or `at` is outside the recording.
CrowdSnapshot read_crowd(const std::string& source, std::optional<double> at);

/// The row of a body. Throws InputError that names `source` and why it has none: there is no such body, or it
/// is not recorded, or not there then.
std::uint32_t row_of(const CrowdSnapshot& crowd, std::int64_t id, const std::string& source);

}  // namespace throng::tools
