// SPDX-License-Identifier: MIT
#include "narrowphase/motion/moving_pair.h"

#include <algorithm>
#include <cmath>

namespace throng::narrowphase {

namespace {

/// Sixteen units in the last place of the lengths that a distance is made of; they amount to about six.
constexpr double kRounding = 0x1p-49;

double l1(const Vec& v) {
  return std::abs(v.x()) + std::abs(v.y());
}

double reach(const Convex& shape) {
  double most = 0.0;
  for (const Vec& v : shape.vertices) most = std::max(most, dot(v, v));
  constexpr double kSquaresKeepTheirDigits = 0x1p-960;
  if (most > kSquaresKeepTheirDigits) [[likely]]
    return std::sqrt(most);
  for (const Vec& v : shape.vertices) most = std::max(most, l1(v));
  return most;
}

}  // namespace

MovingPair::MovingPair(const Convex& shape_a, const Motion& motion_a, const Convex& shape_b,
                       const Motion& motion_b, double duration)
    : a(shape_a),
      b(shape_b),
      angle_a(motion_a.angle),
      angle_b(motion_b.angle),
      spin_a(motion_a.spin),
      spin_b(motion_b.spin),
      offset(motion_b.position - motion_a.position),
      velocity(motion_b.velocity - motion_a.velocity),
      reach_a(reach(shape_a)),
      reach_b(reach(shape_b)),
      radius(shape_a.radius + shape_b.radius) {
  speed = direction(velocity, {1.0, 0.0}).length;
  rate = speed + std::abs(spin_a) * reach_a + std::abs(spin_b) * reach_b;
  const double turned = std::abs(angle_a) * reach_a + std::abs(angle_b) * reach_b;
  rounding = kRounding * (l1(offset) + size() + turned + rate * duration);
}

TimeSpan near(const MovingPair& pair, double duration) {
  constexpr TimeSpan kNever{0.0, -1.0};
  const double size = pair.size();
  const double reach = size + 4.0 * kRounding * (l1(pair.offset) + size + pair.speed * duration);
  const Direction course = direction(pair.velocity, {1.0, 0.0});
  const double along = dot(pair.offset, course.unit), across = std::abs(cross(pair.offset, course.unit));
  if (!(across <= reach)) return kNever;
  if (course.length == 0.0)
    return direction(pair.offset, {1.0, 0.0}).length <= reach ? TimeSpan{0.0, duration} : kNever;
  const double half = std::sqrt((reach - across) * (reach + across));
  if (half < along) return kNever;
  const double enters = (-along - half) / course.length, leaves = (-along + half) / course.length;
  if (!(enters <= duration)) return kNever;
  return {std::max(0.0, enters), std::min(duration, leaves)};
}

}  // namespace throng::narrowphase
