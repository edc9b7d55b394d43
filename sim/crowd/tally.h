// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace throng {

/// Numbers, and how many of them are less than another.
class Tally {
 public:
  void clear() { settled_.clear(), recent_.clear(); }

  /// Adds one of many. Expects no question before `settle`. O(1).
  void push(double x) { settled_.push_back(x); }
  void settle() { std::ranges::sort(settled_); }

  /// Adds one more. O(sqrt n) in the mean: those that were added lately are a short list of their own.
  void add(double x) {
    recent_.insert(std::ranges::upper_bound(recent_, x), x);
    if (recent_.size() * recent_.size() <= kShort * kShort + settled_.size()) return;
    merged_.clear();
    std::ranges::merge(settled_, recent_, std::back_inserter(merged_));
    settled_.swap(merged_);
    recent_.clear();
  }

  /// O(log n).
  std::size_t less_than(double x) const { return rank(settled_, x) + rank(recent_, x); }

 private:
  static constexpr std::size_t kShort = 64;

  static std::size_t rank(const std::vector<double>& sorted, double x) {
    return static_cast<std::size_t>(std::ranges::lower_bound(sorted, x) - sorted.begin());
  }

  std::vector<double> settled_, recent_;  // both ascending
  std::vector<double> merged_;            // kept: allocates to grow alone
};

}  // namespace throng
