// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
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
  std::size_t size() const { return count_; }

  /// Where the next `most` pairs may be written; `keep` says how many of them were.
  Pair* room(std::size_t most) {
    if (capacity_ - count_ < most) grow(most);
    return pairs_.get() + count_;
  }
  void keep(const Pair* end) { count_ = static_cast<std::size_t>(end - pairs_.get()); }

  std::span<Pair> pairs() { return {pairs_.get(), count_}; }
  std::span<const Pair> pairs() const { return {pairs_.get(), count_}; }

 private:
  void grow(std::size_t most);

  std::unique_ptr<Pair[]> pairs_;  // more than are in use, so that a write costs no check
  std::size_t count_ = 0, capacity_ = 0;
};

/// Pairs in the order in which a search met them, one buffer after the other: threads fill one each, and none
/// is copied. Where the buffers meet depends on the number of threads, the order on nothing but the points.
class PairList {
 public:
  /// Makes room for `buffers` empty ones.
  void reset(std::size_t buffers);
  PairBuffer& buffer(std::size_t i) { return buffers_[i]; }

  std::size_t buffers() const { return count_; }
  std::span<const Pair> pairs(std::size_t buffer) const { return buffers_[buffer].pairs(); }
  std::size_t size() const;

  template <class F>
  void for_each(F&& f) const {
    for (std::size_t i = 0; i < count_; ++i)
      for (const Pair& pair : pairs(i)) f(pair);
  }

 private:
  std::vector<PairBuffer> buffers_;  // the first count_ are in use
  std::size_t count_ = 0;
};

/// Brings pairs into ascending order: a counting sort by `a`, then a short sort by `b` for each `a`.
class PairSorter {
 public:
  /// Replaces `sorted` by `found` in ascending order. Rows are below `rows`.
  /// O(rows + m log k), m pairs, k of them for the busiest row; allocates only to grow.
  void sort(const PairList& found, std::size_t rows, std::vector<Pair>& sorted);

 private:
  std::vector<std::uint32_t> next_;  // per row: where its next pair goes
};

}  // namespace throng::broadphase
