// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sim/contact/block_order.h"

namespace throng {

/// Which lane each contact has, over steps.
class SeatBook {
 public:
  /// Between the two, for keys that ascend: the lane that the contact was given; kNoLane where it was given
  /// none, and may be by add(). Allocates only to grow. O(1) amortized.
  void start() {
    std::swap(seats_, last_);
    seats_.clear(), unnamed_.clear(), next_ = 0;
  }
  std::uint32_t lane_of(std::uint64_t key) {
    while (next_ < last_.size() && last_[next_].key < key) leave_out();
    if (next_ == last_.size() || last_[next_].key != key) return kNoLane;
    seats_.push_back(last_[next_++]);
    return seats_.back().lane;
  }
  void finish() {
    while (next_ < last_.size()) leave_out();
  }

  /// For a key above all before.
  void add(std::uint64_t key, std::uint32_t lane) { seats_.push_back({key, lane}); }

  /// The contact has that lane from now on, whether or not it had one. O(contacts).
  void change(std::uint64_t key, std::uint32_t lane) {
    const auto at = std::ranges::lower_bound(seats_, key, {}, &Seat::key);
    if (at != seats_.end() && at->key == key)
      at->lane = lane;
    else
      seats_.insert(at, {key, lane});
  }

  /// Calls f(key, lane) for all, whether or not they were named.
  template <class F>
  void for_each(F f) const {
    for (const auto& [key, lane] : seats_) f(key, lane);
  }

  /// The lanes of contacts that weren't named last; they keep them.
  std::span<const std::uint32_t> unnamed() const { return unnamed_; }

  void forget_all() { seats_.clear(); }

 private:
  struct Seat {
    std::uint64_t key;
    std::uint32_t lane;
  };

  void leave_out() {
    unnamed_.push_back(last_[next_].lane);
    seats_.push_back(last_[next_++]);
  }

  std::vector<Seat> seats_, last_;  // ascending by key
  std::vector<std::uint32_t> unnamed_;
  std::size_t next_ = 0;  // of the last ones
};

}  // namespace throng
