// SPDX-License-Identifier: MIT
#include "sim/contact/soft_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace throng {

namespace {

constexpr double kStrip = 1.2;  // of the mean spacing
constexpr double kAlong = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void SoftPlaces::sort(std::span<const Vec> positions) {
  const std::size_t n = positions.size();
  if (n >= kSome) {
    sort_into_strips(positions);
    row_.push_back(static_cast<std::uint32_t>(n));
  } else if (row_.size() != n + 1) {
    row_.resize(n + 1);
    std::iota(row_.begin(), row_.end(), 0u);
  }
  place_.resize(n + 1);
  for (std::uint32_t place = 0; place <= n; ++place) place_[row_[place]] = place;
}

/// No more strips than bodies, also where these stand in a line.
void SoftPlaces::sort_into_strips(std::span<const Vec> positions) {
  Eigen::AlignedBox2d box;
  for (const Vec& position : positions) box.extend(position);
  const Vec size = box.sizes();
  const int longer = size.x() >= size.y() ? 0 : 1, shorter = 1 - longer;
  const double n = static_cast<double>(positions.size());
  const double strip = kStrip * std::max(std::sqrt(size.x() * size.y() / n), size[longer] / n);
  const auto part = [](double way, double of) { return of > 0.0 ? way / of : 0.0; };
  items_.clear();
  for (std::uint32_t row = 0; row < positions.size(); ++row) {
    const Vec at = positions[row] - box.min();
    const auto across = static_cast<std::uint64_t>(part(at[longer], strip));
    const auto along = static_cast<std::uint64_t>(kAlong * part(at[shorter], size[shorter]));
    items_.push_back({across << 32 | along, row});
  }
  std::ranges::sort(items_, std::less<>());
  row_.clear();
  for (const Item& item : items_) row_.push_back(item.row);
}

}  // namespace throng
