// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

/// Pairs of rows: how they are collected as a search meets them, and how they are brought into order.
namespace throng::broadphase {

/// Two rows of the array that was indexed, a < b.
struct Pair {
  std::uint32_t a, b;
  friend bool operator==(const Pair&, const Pair&) = default;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// Pairs as met, in any order. Grows like a vector, and keeps its memory; appends without a branch.
class PairBuffer {
 public:
  void clear() { count_ = 0; }

  /// Where the next `most` pairs may be written; `keep` says how many of them were.
  Pair* room(std::size_t most) {
    if (pairs_.size() - count_ < most) pairs_.resize(2 * (count_ + most));
    return pairs_.data() + count_;
  }
  void keep(const Pair* end) { count_ = static_cast<std::size_t>(end - pairs_.data()); }

  void add(std::uint32_t row, std::uint32_t other) {
    *room(1) = row < other ? Pair{row, other} : Pair{other, row};
    ++count_;
  }

  std::span<Pair> pairs() { return {pairs_.data(), count_}; }

 private:
  std::vector<Pair> pairs_;  // more than are in use, so that a write costs no check
  std::size_t count_ = 0;
};

/// Brings pairs into ascending order: a counting sort by `a`, then a short sort by `b` for each `a`.
class PairSorter {
 public:
  /// Replaces `sorted` by `found` in ascending order. Rows are below `rows`.
  /// O(rows + m log k), m pairs, k of them for the busiest row; allocates only to grow.
  void sort(std::span<const Pair> found, std::size_t rows, std::vector<Pair>& sorted);

 private:
  std::vector<std::uint32_t> next_;  // per row: where its next pair goes
};

}  // namespace throng::broadphase
