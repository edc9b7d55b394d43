// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace throng {

/// A hall 30 m long: in at its left end, a platform and a gate in the middle, out in the corners of its right
/// end.
inline std::string hall(const std::string& agents, const std::string& model = "collision_free_speed") {
  return "time = { dt = 0.02, until = 1000 }\nseed = 5\n"
         "walkable = 'POLYGON ((0 0, 30 0, 30 10, 0 10, 0 0))'\n[areas]\n"
         "start = [[0, 2], [4, 2], [4, 8], [0, 8]]\nplatform = [[12, 0], [16, 0], [16, 3], [12, 3]]\n"
         "low = [[29, 0], [30, 0], [30, 2], [29, 2]]\nhigh = [[29, 8], [30, 8], [30, 10], [29, 10]]\n"
         "[queues]\ngate = { line = [[20, 5], [14, 5]], service = 2 }\n"
         "fast = { line = [[20, 8], [17, 8]], service = 0.5 }\n"
         "[[agents]]\ndesired_speed = 1\nplace.random.within = 'start'\nmodel = '" +
         model + "'\n" + agents;
}

}  // namespace throng
