// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace throng {

/// s of wall time from one checkpoint to the next.
inline constexpr double kShortestCheckpoint = 1e-3, kLongestCheckpoint = 1e9;

/// Where a recording comes from: enough to run it again.
struct Provenance {
  std::string scenario;      ///< the scenario's text as given
  std::string resolved;      ///< the same with every override applied; loads to the scene
  std::string command_line;  ///< as typed; bytes that are no UTF-8 become U+FFFD in the file
  int threads = 1;
  double checkpoint = 0.0;  ///< s of wall time from one checkpoint to the next; 0: at a stop alone
};

}  // namespace throng
