// SPDX-License-Identifier: MIT
#include "sim/sensing/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/crossing.h"

namespace throng {

using broadphase::Box;
using broadphase::Extent;

namespace {

constexpr double kMostSteps = 4096.0;  // from one point to another

}  // namespace

Sight::Sight(std::span<const Wall> walls, const std::optional<broadphase::Period>& period, double distance)
    : period_(period) {
  for (const Wall& wall : walls)
    for (std::size_t i = 0; i + (wall.closed ? 0 : 1) < wall.points.size(); ++i)
      add(wall.points[i], wall.points[(i + 1) % wall.points.size()]);
  for (const Extent& wall : walls_) bounds_.extend(wall.box());
  const double widest = walls_.empty() ? 0.0 : bounds_.sizes().maxCoeff();
  index_.build(walls_, distance < widest ? 0.25 * distance : 0.0);
}

/// With those images that are at most half a period away from the domain.
void Sight::add(const Vec& a, const Vec& b) {
  walls_.push_back(Extent::of_segment(a, b));
  if (!period_) return;
  const Vec& size = period_->size;
  const Box near(Vec(period_->origin - 0.5 * size), Vec(period_->origin + 1.5 * size));
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y) {
      const Vec shift(x * size.x(), y * size.y());
      const Extent image = Extent::of_segment(a + shift, b + shift);
      if ((x != 0 || y != 0) && near.intersects(image.box())) walls_.push_back(image);
    }
}

bool Sight::sees(const Vec& p, const Vec& q) const {
  if (!period_) return !blocked(p, q);
  const Vec d = q - p,
            nearest(broadphase::fold(d.x(), period_->size.x()), broadphase::fold(d.y(), period_->size.y()));
  return !blocked(p, q - (d - nearest));
}

/// Asks for what is near the segment piece by piece, so that a long slanting one doesn't meet all walls of
/// its box. The pieces' ends are rounded: their boxes are larger by more than that.
bool Sight::blocked(const Vec& p, const Vec& q) const {
  if (!bounds_.intersects(Box(Vec(p.cwiseMin(q)), Vec(p.cwiseMax(q))))) return false;
  const double length = (q - p).cwiseAbs().maxCoeff();
  const double steps = std::clamp(std::ceil(0.5 * length / index_.cell_size()), 1.0, kMostSteps);
  const double slack =
      8.0 * std::numeric_limits<double>::epsilon() * p.cwiseAbs().cwiseMax(q.cwiseAbs()).maxCoeff();
  bool hit = false;
  Vec from = p;
  for (double i = 1.0; i <= steps && !hit; ++i) {
    const Vec to = i == steps ? q : Vec(p + (q - p) * (i / steps));
    const Vec margin(slack, slack);
    const Box box(Vec(from.cwiseMin(to) - margin), Vec(from.cwiseMax(to) + margin));
    index_.for_each_near(box, [&](std::uint32_t row) {
      hit = hit || narrowphase::segments_meet(p, q, walls_[row].a, walls_[row].b);
    });
    from = to;
  }
  return hit;
}

}  // namespace throng
