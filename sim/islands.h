// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/rows.h"

namespace throng {

/// Which rows hang together: sets that joins make larger (Tarjan, J. ACM 22, 215, 1975), each named after its
/// smallest row, so that the order of joins doesn't matter.
class Islands {
 public:
  /// Each of those rows, below `n`, is alone. O(rows); allocates only to grow.
  void start(Rows rows, std::size_t n);

  void join(std::uint32_t a, std::uint32_t b);

  /// The smallest row that hangs together with this one. O(log rows) amortized, nearly constant.
  std::uint32_t first(std::uint32_t row);

 private:
  std::vector<std::uint32_t> nearer_;  // of each row: itself, or one on the way to its first
};

}  // namespace throng
