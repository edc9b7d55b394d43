// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/pairs.h"

namespace throng::broadphase {

/// Of each row its partners in higher rows: pairs on their way into ascending order. `AllPairs` finds discs'
/// so; pairs found in any order are brought here by `assign`.
struct HigherRows {
  struct List {
    std::uint32_t begin, count;  ///< in `rows`
  };
  std::vector<List> of;        ///< per row
  Buffer<std::uint32_t> rows;  ///< those of a list in any order

  /// Replaces all by a search's pairs of rows below `n`. A counting sort, O(n + pairs); allocates only to
  /// grow.
  void assign(const PairList& found, std::size_t n);

  /// Leaves out what is not `movable` from the lists of rows that aren't either.
  void keep_movable(std::span<const std::uint8_t> movable);

  /// Replaces `pairs` by all, ascending: each list is sorted by a network of up to 128 rows, longer ones by
  /// the library. O(n + m log^2 k), m pairs, k of them for the busiest row; allocates only to grow.
  void write(std::vector<Pair>& pairs);
};

}  // namespace throng::broadphase
