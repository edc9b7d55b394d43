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
struct Crowd {
  std::vector<std::uint32_t> id;
  std::vector<Vec> position;  ///< m, in the period where there is one
  std::vector<Vec> velocity;  ///< m/s; empty where it was not recorded
  std::vector<double> angle;  ///< rad; likewise
  std::optional<broadphase::Period> period;
  Scene scene;                      ///< its walls and shapes
  std::vector<std::uint32_t> body;  ///< which row of its bodies each is, counted from 1
};

/// The bodies of a scenario as it starts, or of the frame of a recording that is nearest to time `at` (s),
/// without it the last one. Throws InputError where there is none, or `at` is outside the recording.
Crowd read_crowd(const std::string& source, std::optional<double> at);

/// The row of a body. Throws InputError that names `source` where it has none.
std::uint32_t row_of(const Crowd& crowd, std::int64_t id, const std::string& source);

}  // namespace throng::tools
