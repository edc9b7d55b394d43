// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/spatial_order.h"
#include "sim/contact/contact.h"

namespace throng {

/// Where soft contacts keep bodies: in the order of a curve through the plane, as they stand when a step
/// begins. Those who touch are near in memory then, for as many substeps as the step has. Few bodies keep
/// their rows.
class SoftPlaces {
 public:
  /// Of bodies in rows, and a last row of obstacles, which keeps its place. O(n); allocates only to grow.
  void sort(std::span<const Vec> positions);

  std::uint32_t place(std::uint32_t row) const { return place_[row]; }
  std::uint32_t row(std::uint32_t place) const { return row_[place]; }
  std::size_t size() const { return row_.size(); }

 private:
  /// What is known of fewer bodies fits into the nearest caches.
  static constexpr std::size_t kSome = 2'000;

  broadphase::SpatialOrder curve_;
  std::vector<std::uint32_t> row_, place_;
};

}  // namespace throng
