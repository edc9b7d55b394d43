// SPDX-License-Identifier: MIT
#pragma once

#include "scenarios/grammar.h"

namespace throng::scenarios {

/// The table at the root of a motion file: what `throng motion` reads. Built once.
const Table& motion_grammar();

/// Its JSON Schema: what stands in scenarios/motions/motion.schema.json.
std::string motion_schema();

/// How its reference begins.
inline constexpr const char* kAboutMotions =
    "Motion files are TOML. SI units, radians, counter-clockwise polygons. A shape stands where its own "
    "origin\n"
    "stands, (0, 0) of its coordinates, and turns about it, as in throng pairs.";

}  // namespace throng::scenarios
