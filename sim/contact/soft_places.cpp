// SPDX-License-Identifier: MIT
#include "sim/contact/soft_places.h"

#include <numeric>

namespace throng {

void SoftPlaces::sort(std::span<const Vec> positions) {
  const std::size_t n = positions.size();
  if (n >= kSome) {
    curve_.sort(positions, row_);
    row_.push_back(static_cast<std::uint32_t>(n));
  } else if (row_.size() != n + 1) {
    row_.resize(n + 1);
    std::iota(row_.begin(), row_.end(), 0u);
  }
  place_.resize(n + 1);
  for (std::uint32_t place = 0; place <= n; ++place) place_[row_[place]] = place;
}

}  // namespace throng
