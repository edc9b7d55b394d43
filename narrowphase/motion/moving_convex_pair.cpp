// SPDX-License-Identifier: MIT
#include "narrowphase/motion/moving_convex_pair.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace throng::narrowphase {

namespace {

/// Sixteen units in the last place of the lengths that a distance is made of; they amount to about six.
constexpr double kSixteenUlps = 0x1p-49;

double l1(const Vec& v) {
  return std::abs(v.x()) + std::abs(v.y());
}

/// A point of the shape and how far its vertices are from there, and from the origin.
struct Extent {
  Vec centre;
  double reach, from_origin;
};

double reach(const Convex& shape, const Vec& centre) {
  double most = 0.0;
  for (const Vec& v : shape.vertices) most = std::max(most, dot(v - centre, v - centre));
  constexpr double kSquaresKeepTheirDigits = 0x1p-960;
  if (most > kSquaresKeepTheirDigits) [[likely]]
    return std::sqrt(most);
  for (const Vec& v : shape.vertices) most = std::max(most, l1(v - centre));
  return most;
}

Extent extent(const Convex& shape, double spin) {
  const double from_origin = reach(shape, {0.0, 0.0});
  if (spin != 0.0) return {{0.0, 0.0}, from_origin, from_origin};
  Vec low = shape.vertices[0], high = low;
  for (const Vec& v : shape.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  const Vec middle = 0.5 * (low + high);
  return {middle, reach(shape, middle), from_origin};
}

}  // namespace

MovingConvexPair::MovingConvexPair(const Convex& shape_a, const Motion& motion_a, const Convex& shape_b,
                                   const Motion& motion_b, double duration)
    : a(shape_a),
      b(shape_b),
      angle_a(motion_a.angle),
      angle_b(motion_b.angle),
      spin_a(motion_a.spin),
      spin_b(motion_b.spin),
      offset(motion_b.position - motion_a.position),
      velocity(motion_b.velocity - motion_a.velocity),
      arms(0.0, 0.0),
      radius(shape_a.radius + shape_b.radius),
      speed(direction(velocity, {1.0, 0.0}).length) {
  assert(std::isfinite(speed) && duration >= 0.0 && std::isfinite(duration));
  const Extent of_a = extent(a, spin_a), of_b = extent(b, spin_b);
  if (spin_a == 0.0) arms -= pose_a(0.0).rotate(of_a.centre);
  if (spin_b == 0.0) arms += pose_b(0.0).rotate(of_b.centre);
  reach_a = of_a.reach, reach_b = of_b.reach;
  rate = speed + std::abs(spin_a) * reach_a + std::abs(spin_b) * reach_b;
  const double turned =
      (1.0 + std::abs(angle_a)) * of_a.from_origin + (1.0 + std::abs(angle_b)) * of_b.from_origin;
  rounding = kSixteenUlps * (l1(offset) + turned + radius + rate * duration);
}

TimeSpan near(const MovingConvexPair& pair, double duration) {
  constexpr TimeSpan kEmpty{0.0, -1.0};
  const Vec offset = pair.offset + pair.arms;
  const double coordinates = l1(pair.offset) + l1(pair.arms) + pair.size() + pair.speed * duration;
  const double reach = pair.size() + 4.0 * kSixteenUlps * coordinates;
  const Direction course = direction(pair.velocity, {1.0, 0.0});
  const double along = dot(offset, course.unit), across = std::abs(cross(offset, course.unit));
  if (!std::isfinite(course.length) || !std::isfinite(reach)) return {0.0, duration};
  if (across > reach) return kEmpty;
  if (course.length == 0.0)
    return direction(offset, {1.0, 0.0}).length > reach ? kEmpty : TimeSpan{0.0, duration};
  const double half = std::sqrt(reach - across) * std::sqrt(reach + across);
  if (half < along) return kEmpty;
  const double enters = (-along - half) / course.length, leaves = (-along + half) / course.length;
  if (enters > duration) return kEmpty;
  return {std::max(0.0, enters), std::min(duration, leaves)};
}

}  // namespace throng::narrowphase
