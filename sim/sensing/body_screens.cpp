// SPDX-License-Identifier: MIT
#include "sim/sensing/body_screens.h"

#include <algorithm>

#include "broadphase/neighbours.h"
#include "narrowphase/distance.h"
#include "sim/periodic.h"

namespace throng {

BodyScreens::BodyScreens(const Scene& scene) : scene_(scene) {
  for (const double radius : scene.bodies.radius) largest_ = std::max(largest_, radius);
}

void BodyScreens::place(std::span<const std::uint32_t> id, std::span<const Vec> position,
                        std::span<const double> angle, const broadphase::ProximityTree& tree) {
  id_ = id, position_ = position, angle_ = angle, tree_ = &tree;
}

Vec BodyScreens::apart(const Vec& from, const Vec& to) const {
  const Vec d = to - from;
  const Domain& domain = scene_.domain;
  return domain.kind == DomainKind::periodic ? nearest_image(d, Vec(domain.max - domain.min)) : d;
}

bool BodyScreens::hide(const Vec& from, std::optional<std::uint32_t> own, std::uint32_t to) const {
  const Vec half = 0.5 * apart(from, position_[to]);
  const double reach = half.norm();
  if (reach == 0.0) return false;
  Vec middle = from + half;
  if (scene_.domain.kind == DomainKind::periodic) middle = wrapped(middle, scene_.domain);
  bool hidden = false;
  broadphase::for_each_near(*tree_, {.at = middle}, {.radius = reach + largest_},
                            [&](std::uint32_t row, double) {
                              if (!hidden && row != own && row != to)
                                hidden = is_on(row, half, apart(middle, position_[row]));
                            });
  return hidden;
}

/// Whether the body of a row, with its centre there, touches the segment from -half to half.
bool BodyScreens::is_on(std::uint32_t row, const Vec& half, const Vec& centre) const {
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
