// SPDX-License-Identifier: MIT
#include "tools/framing.h"

#include <algorithm>
#include <vector>

namespace throng::tools {

namespace {

constexpr double kSpread = 0.6;  // of the domain, in both directions: then show all of it

void include(Extent& extent, const Vec& point, double radius = 0.0) {
  extent.min = extent.min.cwiseMin(point - Vec(radius, radius));
  extent.max = extent.max.cwiseMax(point + Vec(radius, radius));
}

/// From the 1st to the 99th percentile in each direction, widened by its own size on all sides.
Extent crowd(std::span<const Vec> positions, double radius) {
  Extent extent;
  std::vector<double> values;
  for (int axis = 0; axis < 2; ++axis) {
    values.clear();
    for (const Vec& position : positions)
      if (!position.hasNaN()) values.push_back(position[axis]);
    std::sort(values.begin(), values.end());
    extent.min[axis] = values[values.size() / 100];
    extent.max[axis] = values[values.size() - 1 - values.size() / 100];
  }
  const Vec margin = extent.size() + Vec(2 * radius, 2 * radius);
  return {extent.min - margin, extent.max + margin};
}

bool inside(const Extent& extent, const Vec& point) {
  return (point.array() >= extent.min.array()).all() && (point.array() <= extent.max.array()).all();
}

/// The bodies that belong to the crowd, and the walls' points that lie where it does.
Extent tight(const Scene& scene, std::span<const Vec> positions) {
  double largest = 0.0;
  for (double r : scene.bodies.radius) largest = std::max(largest, r);
  const Extent near = crowd(positions, largest);
  Extent extent{near.max, near.min};
  for (std::size_t row = 0; row < positions.size(); ++row)
    if (inside(near, positions[row]))
      include(extent, positions[row], scene.bodies.radius[row % scene.bodies.size()]);
  for (const Wall& wall : scene.walls)
    for (const Vec& point : wall.points)
      if (inside(near, point)) include(extent, point);
  return extent;
}

/// Room to breathe, and no empty extent.
Extent with_margin(Extent extent) {
  const double longer = std::max(extent.size().maxCoeff(), 1e-9 * (1 + extent.min.cwiseAbs().maxCoeff()));
  for (int axis = 0; axis < 2; ++axis) {
    const double lack = std::max(0.0, 0.15 * longer - extent.size()[axis]) / 2 + 0.02 * longer;
    extent.min[axis] -= lack;
    extent.max[axis] += lack;
  }
  return extent;
}

/// The floor that agents walk on, and all walls.
Extent of_floor(const Scene& scene) {
  std::vector<Vec> points;
  for (const std::vector<Vec>& ring : scene.crowd.walkable.rings)
    points.insert(points.end(), ring.begin(), ring.end());
  for (const Wall& wall : scene.walls) points.insert(points.end(), wall.points.begin(), wall.points.end());
  if (points.empty()) return {};
  Extent extent{points[0], points[0]};
  for (const Vec& point : points) include(extent, point);
  return extent;
}

}  // namespace

Extent framing(const Scene& scene, std::span<const Vec> positions) {
  const bool bounded = scene.domain.kind != DomainKind::unbounded;
  const Extent domain{scene.domain.min, scene.domain.max};
  if (std::ranges::all_of(positions, [](const Vec& p) { return p.hasNaN(); }))
    return with_margin(bounded ? domain : of_floor(scene));
  const bool walked = std::ranges::find(scene.bodies.kind, BodyKind::agent) != scene.bodies.kind.end();
  if (walked) return with_margin(of_floor(scene));
  Extent extent = tight(scene, positions);
  if (!bounded) return with_margin(extent);
  const bool spread = (extent.size().array() >= kSpread * domain.size().array()).all();
  const bool meets =
      (extent.min.array() < domain.max.array()).all() && (extent.max.array() > domain.min.array()).all();
  if (spread || !meets || scene.domain.kind == DomainKind::periodic) return with_margin(domain);
  extent.min = extent.min.cwiseMax(domain.min);
  extent.max = extent.max.cwiseMin(domain.max);
  // The floor on which things lie, and the sides between which they lie, belong to the picture.
  for (int axis = 0; axis < 2; ++axis)
    if (extent.size()[axis] >= kSpread * domain.size()[axis]) {
      extent.min[axis] = domain.min[axis];
      extent.max[axis] = domain.max[axis];
    }
  return with_margin(extent);
}

}  // namespace throng::tools
