// SPDX-License-Identifier: MIT
#include "sim/crowd/crowd_cells.h"

#include <algorithm>
#include <cmath>

namespace throng {

/// Those in each cell, few, by insertion.
void CrowdCells::order_by(std::span<const std::uint32_t> id) {
  for (std::size_t bucket = 0; bucket + 1 < start_.size(); ++bucket)
    for (std::size_t k = start_[bucket] + std::size_t{1}; k < start_[bucket + 1]; ++k)
      for (std::size_t j = k; j > start_[bucket] && id[row_[j]] < id[row_[j - 1]]; --j)
        std::swap(row_[j], row_[j - 1]);
}

void CrowdCells::sort(std::span<const Vec> position, double reach, std::span<const std::uint32_t> id) {
  const std::size_t n = position.size();
  row_.resize(n), bucket_.resize(n);
  if (n == 0) return;
  Vec low = position[0], high = low;
  for (const Vec& p : position) low = low.cwiseMin(p), high = high.cwiseMax(p);
  low = squared(low), high = squared(high);
  cells_.fit(low, high, reach, n, nullptr);
  if (cells_.shared()) {
    const Vec extent = high - low;
    const double each = 1.0 / static_cast<double>(n);  // about a cell an agent
    cells_.fit(low, high,
               std::max({reach, std::sqrt(extent.x() * each * extent.y()), extent.maxCoeff() * each}), n,
               nullptr);
  }
  start_.assign(cells_.buckets() + 1, 0);
  for (std::size_t row = 0; row < n; ++row) {
    bucket_[row] = static_cast<std::uint32_t>(cells_.bucket(cells_.cell(squared(position[row]))));
    ++start_[bucket_[row]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& start : start_) start = sum += start;
  for (auto row = static_cast<std::uint32_t>(n); row-- > 0;) row_[--start_[bucket_[row]]] = row;
  if (!id.empty()) order_by(id);
}

}  // namespace throng
