// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/contact/contact.h"

namespace throng {

/// Where soft contacts keep bodies: in strips across the longer side of where they are, one disc or so wide,
/// and in these one after the other, as they stand when a step begins. Those who touch are at most two strips
/// apart then, so that what is at hand can go through a whole substep before the next strips come; but for a
/// seam across the strips, whose first and last ones touch, so that nothing is done before all is at hand.
/// Few bodies keep their rows.
class SoftPlaces {
 public:
  /// Of bodies in rows, and a last row of obstacles, which keeps its place. Expects finite positions.
  /// O(n log n); allocates only to grow.
  void sort(std::span<const Vec> positions);

  std::uint32_t place(std::uint32_t row) const { return place_[row]; }
  std::uint32_t row(std::uint32_t place) const { return row_[place]; }
  std::size_t size() const { return row_.size(); }

 private:
  /// What is known of fewer bodies fits into the nearest caches.
  static constexpr std::size_t kSome = 2'000;

  struct Item {
    std::uint64_t at;  // strip, and behind it how far along the strip
    std::uint32_t row;

    bool operator<(const Item& other) const { return at < other.at || (at == other.at && row < other.row); }
  };

  void sort_into_strips(std::span<const Vec> positions);

  std::vector<Item> items_;
  std::vector<std::uint32_t> row_, place_;
};

}  // namespace throng
