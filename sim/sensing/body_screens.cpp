// SPDX-License-Identifier: MIT
#include "sim/sensing/body_screens.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/distance.h"
#include "sim/periodic.h"

namespace throng {

using broadphase::Box;
using broadphase::ProximityTree;

BodyScreens::BodyScreens(const Scene& scene) : scene_(scene), shifts_{Vec(0.0, 0.0)} {
  for (const double radius : scene.bodies.radius) largest_ = std::max(largest_, radius);
  if (scene.domain.kind != DomainKind::periodic) return;
  const Vec size = scene.domain.max - scene.domain.min;
  period_ = {scene.domain.min, size};
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      if (x != 0 || y != 0) shifts_.push_back({x * size.x(), y * size.y()});
}

void BodyScreens::place(std::span<const std::uint32_t> id, std::span<const Vec> position,
                        std::span<const double> angle) {
  id_ = id, position_ = position, angle_ = angle;
  std::vector<double> radius;
  for (const std::uint32_t body : id) radius.push_back(scene_.bodies.radius[body - std::size_t{1}]);
  discs_.build(position, radius);
}

Vec BodyScreens::apart(const Vec& from, const Vec& to) const {
  const Vec d = to - from;
  if (!period_) return d;
  return {broadphase::fold(d.x(), period_->size.x()), broadphase::fold(d.y(), period_->size.y())};
}

bool BodyScreens::hide(const Vec& from, std::optional<std::uint32_t> own, std::uint32_t to) const {
  if (own && *own > to) return hide(position_[to], to, *own);
  const Vec half = 0.5 * apart(from, position_[to]);
  if (half.isZero(0.0) || discs_.leaves.empty()) return false;
  Line line{from + half, half, own, to};
  if (period_) line.middle = wrapped(line.middle, scene_.domain);
  const Vec reach = half.cwiseAbs() + Vec(largest_, largest_);
  return std::ranges::any_of(shifts_, [&](const Vec& shift) {
    const Vec middle = line.middle + shift;
    const bool is_away =
        period_ && !shift.isZero(0.0) &&
        !Box(scene_.domain.min, scene_.domain.max).intersects(Box(Vec(middle - reach), Vec(middle + reach)));
    return !is_away && any_on(line, middle, discs_.level.size() - 2, 0);
  });
}

namespace {

/// Whether the segment from m - half to m + half may come as near as `radius` to a box. The rounding of what
/// is compared is far below the slack.
bool may_touch(const Vec& m, const Vec& half, const ProximityTree::Node& node, std::size_t i, double radius) {
  constexpr double kRoundedUp = 1.0 + 64.0 * std::numeric_limits<double>::epsilon();
  const double low_x = node.low_x[i] - m.x(), high_x = node.high_x[i] - m.x();
  const double low_y = node.low_y[i] - m.y(), high_y = node.high_y[i] - m.y();
  const double x = 0.5 * (low_x + high_x), y = 0.5 * (low_y + high_y);
  const double wide = 0.5 * (high_x - low_x) + radius, tall = 0.5 * (high_y - low_y) + radius;
  const double half_x = std::abs(half.x()), half_y = std::abs(half.y());
  return std::abs(x) <= (half_x + wide) * kRoundedUp && std::abs(y) <= (half_y + tall) * kRoundedUp &&
         std::abs(half.x() * y - half.y() * x) <= (half_x * tall + half_y * wide) * kRoundedUp;
}

}  // namespace

/// Whether any body below a node is on the line, which is looked for round `middle`.
bool BodyScreens::any_on(const Line& line, const Vec& middle, std::size_t level, std::size_t node) const {
  const std::size_t index = discs_.level[level] + node;
  for (std::size_t i = 0; i < ProximityTree::kWidth; ++i) {
    if (!may_touch(middle, line.half, discs_.nodes[index], i, discs_.node_radius[index].of[i])) continue;
    const std::size_t child = node * ProximityTree::kWidth + i;
    if (level > 0 ? any_on(line, middle, level - 1, child) : any_of_leaf(line, child)) return true;
  }
  return false;
}

bool BodyScreens::any_of_leaf(const Line& line, std::size_t leaf) const {
  const std::size_t first = leaf * ProximityTree::kWidth;
  const std::size_t end = std::min(first + ProximityTree::kWidth, discs_.order.size());
  return std::any_of(discs_.order.begin() + static_cast<std::ptrdiff_t>(first),
                     discs_.order.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](std::uint32_t row) { return is_on(line, row); });
}

bool BodyScreens::is_on(const Line& line, std::uint32_t row) const {
  return row != line.own && row != line.to && covers(row, line.half, apart(line.middle, position_[row]));
}

/// Whether the body of a row, with its centre there, touches the segment from -half to half.
bool BodyScreens::covers(std::uint32_t row, const Vec& half, const Vec& centre) const {
  const std::size_t body = id_[row] - std::size_t{1};
  const double radius = scene_.bodies.radius[body];
  if ((nearest_on_segment(-half, half, centre) - centre).squaredNorm() > radius * radius) return false;
  const Shape& shape = scene_.shapes[scene_.bodies.shape[body]];
  if (shape.kind == ShapeKind::disc) return true;
  const narrowphase::Convex line = narrowphase::segment(-half, half);
  const narrowphase::Pose pose = narrowphase::pose(centre, angle_.empty() ? 0.0 : angle_[row]);
  return std::ranges::any_of(shape.parts, [&](const narrowphase::Convex& part) {
    return narrowphase::separation(line, {}, part, pose).distance <= 0.0;
  });
}

}  // namespace throng
