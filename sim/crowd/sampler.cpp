// SPDX-License-Identifier: MIT
#include "sim/crowd/sampler.h"

#include <algorithm>
#include <cmath>

namespace throng {

Sampler::Sampler(const Region& region, double radius) : region_(region) {
  const Eigen::AlignedBox2d box = bounds(region);
  cell_ = box.sizes().maxCoeff() / kCells;
  const double half = std::sqrt(0.5) * cell_ * (1.0 + 1e-9);
  const int columns = static_cast<int>(std::ceil(box.sizes().x() / cell_ - 1e-9));
  const int rows = static_cast<int>(std::ceil(box.sizes().y() / cell_ - 1e-9));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vec corner = box.min() + cell_ * Vec(column, row), middle = corner + 0.5 * Vec(cell_, cell_);
      const double border = (nearest_on_border(region, middle) - middle).norm();
      const double deepest = (contains(region, middle) ? border : -border) + half;
      if (deepest >= radius) cells_.push_back(corner);
    }
}

Vec Sampler::draw(Random& random) const {
  const auto last = cells_.size() - 1;
  const auto cell =
      std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(cells_.size())), last);
  const double x = random.uniform(0.0, cell_);
  return cells_[cell] + Vec(x, random.uniform(0.0, cell_));
}

bool Sampler::holds(const Vec& centre, double radius) const {
  return contains(region_, centre) && (nearest_on_border(region_, centre) - centre).norm() >= radius;
}

}  // namespace throng
