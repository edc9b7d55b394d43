// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "broadphase/neighbours.h"

namespace throng::broadphase {

/// Ascending by distance; of equally near ones the lower row first.
inline bool nearer(const Neighbour& a, const Neighbour& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.row < b.row;
}

/// The nearest `most` of all that are added: few in a sorted list, many in a heap.
class BestFew {
 public:
  /// `room` holds `most` > 0 neighbours, and is the caller's.
  BestFew(Neighbour* room, std::size_t most) : list_(room), most_(most) {}

  bool full() const { return count_ == most_; }
  const Neighbour& last() const { return list_[most_ <= kFew ? count_ - 1 : 0]; }  ///< once full

  /// O(log most). False where it was not near enough.
  bool add(const Neighbour& one) {
    if (full() && !nearer(one, last())) return false;
    if (most_ <= kFew)
      insert(one);
    else
      push(one);
    return true;
  }

  /// Brings them into order, and says how many there are.
  std::size_t finish() {
    if (most_ > kFew) std::sort(list_, list_ + count_, nearer);
    return count_;
  }

 private:
  static constexpr std::size_t kFew = 64;  // moving so many up is about as cheap as a heap

  void insert(const Neighbour& one) {
    Neighbour* at = list_ + (full() ? count_ - 1 : count_++);
    for (; at != list_ && nearer(one, at[-1]); --at) *at = at[-1];
    *at = one;
  }
  void push(const Neighbour& one) {
    if (full())
      std::pop_heap(list_, list_ + count_, nearer);
    else
      ++count_;
    list_[count_ - 1] = one;
    std::push_heap(list_, list_ + count_, nearer);
  }

  Neighbour* list_;
  std::size_t most_, count_ = 0;
};

}  // namespace throng::broadphase
