// SPDX-License-Identifier: MIT
#include "narrowphase/weld.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace throng::narrowphase {

namespace {

constexpr std::uint32_t kUnnumbered = ~std::uint32_t{0};

using Cell = std::pair<double, double>;

/// The points by cells four slacks wide: whoever is within a slack is in one of nine cells.
class ByCell {
 public:
  ByCell(std::span<const Vec> points, double slack) : width_(4.0 * slack) {
    for (std::uint32_t i = 0; i < points.size(); ++i) places_.emplace_back(cell(points[i]), i);
    std::ranges::sort(places_);
  }

  /// Calls visit(row) for all in the cells round a point.
  template <class F>
  void for_each_near(const Vec& point, F visit) const {
    const Cell own = cell(point);
    for (double dx = -1.0; dx <= 1.0; ++dx) {  // three cells one above the other stand together
      const Cell low(own.first + dx, own.second - 1.0), high(own.first + dx, own.second + 1.0);
      for (auto at = std::ranges::lower_bound(places_, std::pair(low, std::uint32_t{0}));
           at != places_.end() && at->first <= high; ++at)
        visit(at->second);
    }
  }

 private:
  Cell cell(const Vec& p) const { return {std::floor(p.x() / width_), std::floor(p.y() / width_)}; }

  double width_;
  std::vector<std::pair<Cell, std::uint32_t>> places_;
};

}  // namespace

double rounding(std::span<const Vec> points) {
  double most = 0.0;
  for (const Vec& p : points) most = std::max(most, p.lpNorm<Eigen::Infinity>());
  return 0x1p-48 * most;
}

std::vector<std::uint32_t> weld(std::span<const Vec> points) {
  const double slack = rounding(points);
  const ByCell by_cell(points, slack > 0.0 ? slack : 1.0);  // where all stand at the origin, any cell does
  std::vector<std::uint32_t> numbers(points.size(), kUnnumbered);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (numbers[i] != kUnnumbered) continue;
    by_cell.for_each_near(points[i], [&](std::uint32_t j) {
      if (numbers[j] == kUnnumbered && (points[j] - points[i]).lpNorm<Eigen::Infinity>() <= slack)
        numbers[j] = next;
    });
    ++next;
  }
  return numbers;
}

}  // namespace throng::narrowphase
