// SPDX-License-Identifier: MIT
#include "tools/bench/peers/chipmunk.h"

namespace throng::bench {

std::unique_ptr<Simulation> chipmunk_simulation(const Scene&, int) {
  return nullptr;
}

}  // namespace throng::bench
