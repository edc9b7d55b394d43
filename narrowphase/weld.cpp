// SPDX-License-Identifier: MIT
#include "narrowphase/weld.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace throng::narrowphase {

namespace {

using Cell = std::pair<double, double>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    return std::hash<double>()(cell.first) * 0x9E3779B97F4A7C15u ^ std::hash<double>()(cell.second);
  }
};

/// The points known so far, by cells four slacks wide: whoever is within a slack is in one of nine cells.
class Known {
 public:
  explicit Known(double slack) : slack_(slack), width_(4.0 * slack) {}

  std::uint32_t number(const Vec& p) {
    const Cell cell{std::floor(p.x() / width_), std::floor(p.y() / width_)};
    for (double dx = -1.0; dx <= 1.0; ++dx)
      for (double dy = -1.0; dy <= 1.0; ++dy)
        if (const auto found = cells_.find({cell.first + dx, cell.second + dy}); found != cells_.end())
          if ((points_[found->second] - p).lpNorm<Eigen::Infinity>() <= slack_) return found->second;
    points_.push_back(p);
    cells_.emplace(cell, static_cast<std::uint32_t>(points_.size() - 1));
    return static_cast<std::uint32_t>(points_.size() - 1);
  }

 private:
  double slack_, width_;
  std::vector<Vec> points_;
  std::unordered_map<Cell, std::uint32_t, CellHash> cells_;
};

}  // namespace

double rounding(std::span<const Vec> points) {
  double most = 0.0;
  for (const Vec& p : points) most = std::max(most, p.lpNorm<Eigen::Infinity>());
  return 0x1p-48 * most;
}

std::vector<std::uint32_t> weld(std::span<const Vec> points) {
  const double slack = rounding(points);
  Known known(slack > 0.0 ? slack : 1.0);  // where all stand at the origin, any cell does
  std::vector<std::uint32_t> numbers;
  for (const Vec& p : points) numbers.push_back(known.number(p));
  return numbers;
}

}  // namespace throng::narrowphase
