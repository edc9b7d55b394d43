// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/motion_cases.h"

/// Who answers the questions of motion_cases.h.
namespace throng::bench {

struct Told {
  narrowphase::Verdict verdict;
  double time = 0.0;  ///< of a hit
  std::size_t evaluations = 0;
};

/// What an engine promises.
enum class Promise {
  exact,   ///< says hit and free only where it is so, and undecided hardly ever
  filter,  ///< is right where it says free; else it says undecided
  none     ///< may be wrong
};

struct MotionEngine {
  std::string name;
  Promise promise;
  bool first;  ///< a hit's time is that of the first contact
  std::function<Told(std::size_t query)> ask;
};

/// All that can be asked about a case; `c` must live as long. Samples down to 1e-5 of the size apart, or 1e-3
/// for solids of many parts and if `quick`.
std::vector<MotionEngine> motion_engines(const MotionCase& c, bool quick);

}  // namespace throng::bench
