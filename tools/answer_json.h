// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "narrowphase/motion/bisect.h"

/// How answers put it.
namespace throng::tools {

inline nlohmann::ordered_json json(const Eigen::Vector2d& v) {
  return {v.x(), v.y()};
}

inline const char* word(narrowphase::Verdict verdict) {
  return verdict == narrowphase::Verdict::free  ? "free"
         : verdict == narrowphase::Verdict::hit ? "hit"
                                                : "undecided";
}

}  // namespace throng::tools
