// SPDX-License-Identifier: MIT
#include "sim/crowd/standing.h"

#include <algorithm>

namespace throng {

namespace {

constexpr std::size_t kFewest = 32;  // as many as cost no more to look at one by one than a grid

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

void Standing::sort() {
  sorted_ = centre_.size();
  cells_.sort(centre_, 4.0 * largest_);
}

bool Standing::meets(const Vec& centre, double radius) {
  if (centre_.size() > sorted_ + kFewest + sorted_ / 16) sort();
  for (std::size_t disc = sorted_; disc < centre_.size(); ++disc)
    if (overlaps(disc, centre, radius)) return true;
  if (sorted_ == 0) return false;
  bool found = false;
  cells_.for_each_stretch(centre, radius + largest_, [&](std::size_t first, std::size_t end) {
    for (std::size_t place = first; place < end && !found; ++place)
      found = overlaps(cells_.row()[place], centre, radius);
  });
  return found;
}

}  // namespace throng
