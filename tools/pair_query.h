// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "narrowphase/motion/motion.h"

namespace throng::tools {

/// A shape of `throng pairs`, the union of its convex parts: where it stands, and how it goes on from there.
struct Solid {
  std::vector<narrowphase::Convex> parts;
  narrowphase::Pose pose;
  narrowphase::Motion motion;
};

/// One line of `throng pairs`.
struct PairQuery {
  Solid a, b;
  double epsilon = 0.0;              ///< accepted relative error of the distance
  std::optional<double> until;       ///< s, never negative; there where anything moves
  std::vector<std::string> repairs;  ///< what was mended in the polygons
};

/// A line as JSON. Throws InputError where it is none, has a key twice in one object or is nested too deep.
nlohmann::ordered_json parse_line(std::string_view text);

/// The "id" of a line, a string or a number; null where there is none. Throws InputError where it is anything
/// else.
nlohmann::ordered_json read_id(const nlohmann::ordered_json& line);

/// What a line asks, its id aside. Throws InputError with what is wrong and where in the line: a key that is
/// unknown or missing, a wrong type, a number that is not finite, a shape that is none, a motion without end.
PairQuery read_pair(const nlohmann::ordered_json& line);

}  // namespace throng::tools
