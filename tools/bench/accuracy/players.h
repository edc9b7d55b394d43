// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "sim/simulation.h"

/// Who plays the scenes of the laboratory. A further engine is one more row of `players()`.
namespace throng::bench {

struct Player {
  const char* engine;
  bool peer;                                 ///< somebody else's engine
  const char* knob;                          ///< what buys accuracy beside dt; "" where nothing does
  std::span<const int> knobs;                ///< its settings
  Scene (*prepared)(Scene scene, int knob);  ///< throws InputError where it can't play it
  std::unique_ptr<Simulation> (*start)(const Scene& prepared, int knob);  ///< null where it isn't there
  double (*asked)(int knob) = nullptr;  ///< the error that it chooses dt for itself for; null: dt is given
  bool instant = true;                  ///< collisions take no time
};

std::span<const Player> players();

}  // namespace throng::bench
