// SPDX-License-Identifier: MIT
#include "sim/crowd/distance_field.h"

#include <algorithm>
#include <cmath>

#include "sim/crowd/march.h"

namespace throng {

namespace {

constexpr double kFaint = 0.1;  // of the slope of a straight way: where ways part, less says nothing
constexpr int kSeedCells = 6;   // as far round the goal distances are exact, where nothing stands in between

/// The nodes in and round the goal whose distance is that of the straight way.
std::vector<Seed> seeds_for(const FloorPlan& plan, const Barriers& barriers, const Region& goal) {
  const double far = kSeedCells * plan.cell;
  const Eigen::AlignedBox2d box = bounds(goal);
  const auto to_index = [&](double x, int count) {
    return static_cast<int>(std::clamp(std::floor(x), 0.0, static_cast<double>(count)));
  };
  const Vec low = (box.min() - plan.origin) / plan.cell, high = (box.max() - plan.origin) / plan.cell;
  std::vector<Seed> seeds;
  for (int row = to_index(low.y() - kSeedCells, plan.rows);
       row < to_index(high.y() + kSeedCells + 1, plan.rows); ++row)
    for (int column = to_index(low.x() - kSeedCells, plan.columns);
         column < to_index(high.x() + kSeedCells + 1, plan.columns); ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * plan.columns + column;
      if (plan.footing[i] == Footing::none) continue;
      const Vec p = plan.node(i);
      if (contains(goal, p)) {
        seeds.push_back({i, 0.0});
        continue;
      }
      const Vec q = nearest_on_border(goal, p);
      const double distance = (q - p).norm();
      if (distance <= far && !barriers.block(p, q)) seeds.push_back({i, distance});
    }
  return seeds;
}

Vec unit(const Vec& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec(v / length) : Vec(0.0, 0.0);
}

/// The plane that fits some heights best, by weight.
class Plane {
 public:
  /// `at` beside where it is asked for.
  void add(const Vec& at, double height, double weight) {
    const Vec weighted = weight * at;
    mass_ += weight, middle_ += weighted, height_ += weight * height;
    xx_ += weighted.x() * at.x(), xy_ += weighted.x() * at.y(), yy_ += weighted.y() * at.y();
    rise_ += height * weighted;
  }

  /// Which way it falls; zero where the heights don't say.
  Vec fall() const {
    if (!(mass_ > 0.0)) return {0.0, 0.0};
    const double xx = xx_ - middle_.x() * middle_.x() / mass_, yy = yy_ - middle_.y() * middle_.y() / mass_;
    const double xy = xy_ - middle_.x() * middle_.y() / mass_, all = xx * yy - xy * xy;
    if (!(all > kFlat * (xx + yy) * (xx + yy))) return {0.0, 0.0};
    const Vec rise = rise_ - height_ / mass_ * middle_;
    return {(xy * rise.y() - yy * rise.x()) / all, (xy * rise.x() - xx * rise.y()) / all};
  }

 private:
  static constexpr double kFlat = 1e-4;  // nodes in a line say nothing of what is beside it
  double mass_ = 0.0, height_ = 0.0, xx_ = 0.0, xy_ = 0.0, yy_ = 0.0;
  Vec middle_{0.0, 0.0}, rise_{0.0, 0.0};
};

/// Of a node `x` cells away: a cubic B-spline, so that directions change smoothly as nodes come and go.
double bell(double x) {
  const double far = std::abs(x), left = 2.0 - far;
  if (far >= 2.0) return 0.0;
  return far < 1.0 ? 4.0 - 3.0 * far * far * left : left * left * left;
}

}  // namespace

DistanceField::DistanceField(const FloorPlan& plan, const Barriers& barriers, const Region& goal)
    : plan_(&plan), barriers_(&barriers), goal_(goal), per_cell_(1.0 / plan.cell) {
  distance_ = march(plan, barriers, seeds_for(plan, barriers, goal));
  mark_broken();
}

void DistanceField::mark_broken() {
  const auto columns = static_cast<std::size_t>(plan_->columns);
  for (std::size_t node = 0; node < distance_.size(); ++node)
    for (const std::size_t corner : {node, node + 1, node + columns, node + columns + 1}) {
      const bool is_good = corner < distance_.size() && plan_->footing[corner] >= Footing::close &&
                           std::abs(distance_[corner]) < kUnreached;
      if (!is_good) distance_[node] = -std::abs(distance_[node]);
    }
}

bool DistanceField::leads_from_anywhere() const {
  return std::ranges::any_of(distance_, [](float d) { return d != 0.0f && std::abs(d) < kUnreached; });
}

double DistanceField::distance(const Vec& p) const {
  Cell cell;
  if (goal_(p)) return 0.0;
  if (!locate(p, cell)) return kUnreached;
  if (!is_whole(cell.node)) {
    double distance = kUnreached;
    nearest_way(p, cell, 0.0, distance);
    return distance;
  }
  const std::size_t low = cell.node, high = low + static_cast<std::size_t>(plan_->columns);
  return (1.0 - cell.v) * ((1.0 - cell.u) * at(low) + cell.u * at(low + 1)) +
         cell.v * ((1.0 - cell.u) * at(high) + cell.u * at(high + 1));
}

template <class F>
void DistanceField::for_each_known(const Cell& cell, F&& f) const {
  const auto columns = static_cast<std::size_t>(plan_->columns);
  const std::size_t row = cell.node / columns, column = cell.node % columns;
  for (std::size_t y = row - (row > 0); y < std::min<std::size_t>(row + 3, plan_->rows); ++y)
    for (std::size_t x = column - (column > 0); x < std::min(column + 3, columns); ++x)
      if (at(y * columns + x) < kUnreached) f(y * columns + x);
}

std::size_t DistanceField::nearest_way(const Vec& p, const Cell& cell, double nearest,
                                       double& distance) const {
  std::size_t best = plan_->size();
  for_each_known(cell, [&](std::size_t node) {
    const Vec to = plan_->node(node);
    const double way = (to - p).norm(), length = at(node) + way;
    if (!(way >= nearest && length < distance) || barriers_->block(p, to)) return;
    best = node, distance = length;
  });
  return best;
}

Vec DistanceField::fall_of_visible(const Vec& p, const Cell& cell) const {
  Plane plane;
  for_each_known(cell, [&](std::size_t node) {
    const Vec to = plan_->node(node), away = (to - p) * per_cell_;
    const double weight = bell(away.x()) * bell(away.y());
    if (weight > 0.0 && !barriers_->block(p, to)) plane.add(away, at(node) * per_cell_, weight);
  });
  return plane.fall();
}

Vec DistanceField::direction(const Vec& p) const {
  Vec down;
  if (slope(p, down)) return unit(down);
  Cell cell;
  if (!locate(p, cell)) return {0.0, 0.0};
  if (goal_(p)) return {0.0, 0.0};
  const Vec fall = fall_of_visible(p, cell);
  if (fall.squaredNorm() > kFaint * kFaint) return unit(fall);
  double distance = kUnreached;
  const std::size_t node = nearest_way(p, cell, plan_->cell, distance);
  return node < plan_->size() ? unit(plan_->node(node) - p) : Vec(0.0, 0.0);
}

}  // namespace throng
