// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sim/simulation.h"
#include "tools/bench/stability/stress.h"

namespace throng::bench {

enum class Stability { stable, drifting, exploded };
const char* verdict_name(Stability verdict);

/// What became of a scene under stress.
struct Endured {
  /// Largest gain over what there was at first; where nothing rubs nor damps also loss.
  double energy = 0.0;
  double overlap = 0.0;  ///< deepest at the end, radii
  /// Root mean square at the end, over sqrt(g size); of the gas over what each component has at first.
  double speed = 0.0;
  double moved = 0.0;      ///< of the stack how far a box is off its place at the end, sides
  std::int64_t steps = 0;  ///< that it went
  double ms = 0.0;         ///< of all of them
  std::string end = "";    ///< why the run ended before its time; "" where it didn't
  Stability verdict = Stability::stable;
};

/// Plays it to its end. exploded: the run broke off, energy grew by more than a tenth, or somebody left the
/// box. drifting: energy by more than a hundredth (what keeps its energy: changed), overlaps of more than a
/// tenth of a radius, and of what should be at rest by then: boxes more than a tenth of a side off, or
/// speeds of more than a tenth of what a fall by the size of a body makes.
Endured endure(Stressed which, const Stress& stress);

}  // namespace throng::bench
