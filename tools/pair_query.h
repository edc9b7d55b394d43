// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "narrowphase/convex.h"

namespace throng::tools {

/// A shape of `throng pairs` and where it stands: the union of its convex parts.
struct Solid {
  std::vector<narrowphase::Convex> parts;
  narrowphase::Pose pose;
};

/// One line of `throng pairs`.
struct PairQuery {
  nlohmann::ordered_json id;  ///< as given, a string or a number; null if none was
  Solid a, b;
  double epsilon = 0.0;              ///< accepted relative error of the distance
  std::vector<std::string> repairs;  ///< what was mended in the polygons
};

/// Replaces `query` by what one line asks. Throws InputError with what is wrong and where in the line: no
/// JSON, a key that is unknown, missing or there twice, a wrong type, a number that is not finite, a shape
/// that is none, motion; `query.id` then stands as far as the line has one.
void read_pair(std::string_view line, PairQuery& query);

}  // namespace throng::tools
