// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/pairs.h"

namespace throng::broadphase {

/// Of each row its partners in higher rows: pairs on their way into ascending order, fewer than 2^32.
/// `AllPairs` finds discs' so; pairs found in any order are brought here by `assign`.
struct HigherRows {
  struct List {
    std::uint32_t begin, count;  ///< in `rows`
  };
  static constexpr std::size_t kRoom = 128;  ///< rows and pairs that `write` may touch behind the last

  std::vector<List> of;        ///< per row
  Buffer<std::uint32_t> rows;  ///< those of a list in any order

  /// Replaces all by a search's pairs of rows below `n`. A counting sort, O(n + pairs); allocates only to
  /// grow.
  void assign(const PairList& found, std::size_t n);

  /// Drops the pairs of which neither row is `movable`; expects an entry for each row.
  void keep_movable(std::span<const std::uint8_t> movable);

  /// Replaces `pairs` by all, ascending: lists of up to eight vectors are sorted by a network, longer ones by
  /// the library. O(n + m log^2 k), m pairs, k of them for the busiest row; allocates only to grow.
  void write(std::vector<Pair>& pairs);
};

}  // namespace throng::broadphase
