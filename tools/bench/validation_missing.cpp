// SPDX-License-Identifier: MIT
#include "tools/bench/validation_cases.h"

namespace throng::bench {

std::span<const ValidationCase> missing_cases() {
  static const ValidationCase all[] = {
      {"NIST 2.9: groups", "agents keep no company: none waits for another", "", 0.0, 0.0, nullptr},
      {"NIST 4.1: an exit that closes", "exits are open or closed for the whole run", "", 0.0, 0.0, nullptr},
      {"RiMEA 11: choice of exits", "exits are chosen by the way alone, whoever waits there", "", 0.0, 0.0,
       nullptr},
      {"RiMEA 14: choice of routes", "the shortest route is taken, always", "", 0.0, 0.0, nullptr},
      {"RiMEA 15: large crowd round a corner", "no scenario of it yet", "", 0.0, 0.0, nullptr},
      {"RiMEA 16: single file in a ring", "agents need a floor that is not periodic", "", 0.0, 0.0, nullptr},
  };
  return all;
}

}  // namespace throng::bench
