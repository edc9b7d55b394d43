// SPDX-License-Identifier: MIT
#include "broadphase/spatial_order.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace throng::broadphase {

namespace {

constexpr double kSteps = 65535.0;        // a side: the curve's places fit into 32 bits
constexpr std::size_t kDense = 8;         // as many points may share a place
constexpr std::size_t kFewToSort = 1024;  // below, comparing is faster than counting

/// What four levels of the curve make of four bits of x and of y: eight bits of the place, and how the
/// quadrant that they lead to lies. A quadrant is mirrored (1), or its axes are swapped (2), or both.
struct Step {
  std::uint8_t place, lie;
};

constexpr std::array<Step, 4 * 256> steps() {
  std::array<Step, 4 * 256> table{};
  for (unsigned i = 0; i < table.size(); ++i) {
    unsigned lie = i >> 8, place = 0;
    for (int bit = 3; bit >= 0; --bit) {
      const unsigned mirrored = lie & 1;
      unsigned x = ((i >> (4 + bit)) & 1) ^ mirrored, y = ((i >> bit) & 1) ^ mirrored;
      if (lie & 2) {
        const unsigned swapped = x;
        x = y;
        y = swapped;
      }
      place = place << 2 | ((3 * x) ^ y);
      if (y == 0) lie ^= 2 | x;
    }
    table[i] = {static_cast<std::uint8_t>(place), static_cast<std::uint8_t>(lie)};
  }
  return table;
}
constexpr auto kStep = steps();

/// The place of a cell along the curve through 2^16 by 2^16 of them.
std::uint64_t place(std::uint32_t x, std::uint32_t y) {
  std::uint64_t result = 0;
  unsigned lie = 0;
  for (int bits = 12; bits >= 0; bits -= 4) {
    const Step step = kStep[lie << 8 | ((x >> bits) & 15) << 4 | ((y >> bits) & 15)];
    result = result << 8 | step.place;
    lie = step.lie;
  }
  return result;
}

std::uint32_t row_of(std::uint64_t item) {
  return static_cast<std::uint32_t>(item);
}

}  // namespace

void SpatialOrder::sort(std::span<const Point> points, std::vector<std::uint32_t>& order) {
  assert(points.size() < std::numeric_limits<std::uint32_t>::max());
  items_.resize(points.size());
  for (std::size_t row = 0; row < points.size(); ++row) items_[row] = row;
  other_.resize(points.size());
  sort(points, std::span(items_));
  order.resize(points.size());
  std::ranges::transform(items_, order.begin(), row_of);
}

void SpatialOrder::sort(std::span<const Point> points, std::span<std::uint64_t> items) {
  if (items.empty()) return;
  Point low = points[row_of(items[0])], high = low;
  for (const std::uint64_t item : items) {
    low = low.cwiseMin(points[row_of(item)]);
    high = high.cwiseMax(points[row_of(item)]);
  }
  const double scale = kSteps / (high - low).maxCoeff();
  if (!std::isfinite(scale)) return;  // all coincide, as far as numbers tell
  for (std::uint64_t& item : items) {
    const Point at = (points[row_of(item)] - low) * scale;
    item = place(static_cast<std::uint32_t>(at.x()), static_cast<std::uint32_t>(at.y())) << 32 | row_of(item);
  }
  sort_by_key(items);
  // The two ends of the longer side lie on different places, so that a part is smaller than the whole.
  for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
    while (end < items.size() && items[end] >> 32 == items[begin] >> 32) ++end;
    if (end - begin <= kDense) continue;
    for (std::uint64_t& item : items.subspan(begin, end - begin)) item = row_of(item);
    sort(points, items.subspan(begin, end - begin));
  }
}

/// By place, then row, as rows ascend to begin with: a counting sort by 11 bits at a time, the lowest first.
void SpatialOrder::sort_by_key(std::span<std::uint64_t> items) {
  if (items.size() < kFewToSort) {
    std::sort(items.begin(), items.end());
    return;
  }
  std::span<std::uint64_t> from = items, to = std::span(other_).first(items.size());
  for (int shift = 32; shift < 64; shift += 11) {
    std::array<std::uint32_t, 2048> next{};
    for (const std::uint64_t item : from) ++next[(item >> shift) & 2047];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : next) {
      const std::uint32_t count = start;
      start = sum;
      sum += count;
    }
    for (const std::uint64_t item : from) to[next[(item >> shift) & 2047]++] = item;
    std::swap(from, to);
  }
  std::ranges::copy(from, items.begin());
}

}  // namespace throng::broadphase
