// SPDX-License-Identifier: MIT
#include "sim/crowd/standing.h"

#include <algorithm>

namespace throng {

namespace {

constexpr std::size_t kMostUnsorted = 32;  // as many as cost no more to look at one by one than a grid

}  // namespace

void Standing::clear() {
  centre_.clear(), radius_.clear();
  largest_ = 0.0;
  sorted_ = 0;
}

void Standing::add(const Vec& centre, double radius) {
  centre_.push_back(centre), radius_.push_back(radius);
  largest_ = std::max(largest_, radius);
}

void Standing::sort_if_many_are_new() {
  if (centre_.size() <= sorted_ + kMostUnsorted + sorted_ / 16) return;
  sorted_ = centre_.size();
  cells_.sort(centre_, 4.0 * largest_);
}

}  // namespace throng
