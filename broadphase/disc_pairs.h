// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/all_pairs.h"

/// Which discs may touch, whatever their sizes, in ascending order: for a step whose result depends on the
/// order of its pairs.
namespace throng::broadphase {

class DiscPairs {
 public:
  /// Replaces `pairs` by all rows a < b with |c_a - c_b| <= reach[a] + reach[b] (m), ascending, each once.
  /// Where `movable` is not empty, pairs of which neither row is movable are left out.
  /// Expects and costs as `AllPairs::find_discs` does by rows, and as `HigherRows::write`.
  void find(std::span<const Point> centres, std::span<const double> reach, const Period* period,
            std::vector<Pair>& pairs, std::span<const std::uint8_t> movable = {});

 private:
  AllPairs search_;
  HigherRows found_;
};

}  // namespace throng::broadphase
