// SPDX-License-Identifier: MIT
#include "narrowphase/motion/clear_time.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/relative.h"

namespace throng::narrowphase {

namespace {

/// When height + slope t - bend t² / 2 comes down to 0; expects height > 0, bend >= 0.
double root(double height, double slope, double bend) {
  const double r = std::sqrt(slope * slope + 2.0 * bend * height);
  if (slope < 0.0) return 2.0 * height / (r - slope);
  return bend > 0.0 ? (r + slope) / bend : std::numeric_limits<double>::infinity();
}

/// Shortens `time` to when a vertex comes down.
void shorten(double height, double slope, double bend, double& time) {
  if (height + time * (slope - 0.5 * bend * time) < 0.0) time = std::min(time, root(height, slope, bend));
}

/// Along an axis that turns with the one that stays.
ClearTime clear_time(const Standing& stays, double spin, const Standing& moves, double spin_moving,
                     const Vec& normal, const Vec& velocity, const RelativeMotion& motion, double margin,
                     const ClearTime& wanted) {
  const Vec offset = moves.pose.position - stays.pose.position;
  double floor = -std::numeric_limits<double>::infinity();
  for (const Vec& v : stays.vertices) floor = std::max(floor, dot(normal, stays.pose.rotate(v)));
  const double distance = direction(offset, {1.0, 0.0}).length;
  const double farthest = distance + motion.speed * std::max(wanted.before, wanted.after);
  const double turn = std::abs(spin), turning = std::abs(spin_moving - spin);
  const double bend = (1.0 + 0x1p-40) * (motion.acceleration + turn * (2.0 * motion.speed + turn * farthest) +
                                         turning * turning * moves.far);
  const double rounding = 0x1p-46 * (motion.speed + turn * distance + turning * moves.far);
  const double height = dot(normal, offset) - floor - margin;
  const double slope = dot(normal, velocity) + spin * cross(normal, offset);
  ClearTime clear = wanted;
  for (const Vec& v : moves.vertices) {
    const Vec u = moves.pose.rotate(v);
    const double h = height + dot(normal, u), rising = slope + (spin - spin_moving) * cross(normal, u);
    if (!(h > 0.0) || !(bend < std::numeric_limits<double>::infinity())) return {0.0, 0.0};
    shorten(h, -rising - rounding, bend, clear.before);
    shorten(h, rising - rounding, bend, clear.after);
  }
  constexpr double kRounding = 1.0 - 0x1p-46;
  return {kRounding * clear.before, kRounding * clear.after};
}

}  // namespace

ClearTime clear_time(const OpenGap& gap, const RelativeMotion& motion, const ClearTime& wanted) {
  const ClearTime with_a = clear_time(gap.a, motion.spin_a, gap.b, motion.spin_b, gap.normal, motion.velocity,
                                      motion, gap.margin, wanted);
  const ClearTime with_b = clear_time(gap.b, motion.spin_b, gap.a, motion.spin_a, -gap.normal,
                                      -motion.velocity, motion, gap.margin, wanted);
  return longer(with_a, with_b);
}

ClearTime clear_time(const BallGap& gap, const RelativeMotion& motion) {
  const double distance = std::sqrt(dot(gap.offset, gap.offset)), height = distance - gap.margin;
  if (!(height > 0.0)) return {0.0, 0.0};
  const double arm_a = std::sqrt(dot(gap.arm_a, gap.arm_a)), arm_b = std::sqrt(dot(gap.arm_b, gap.arm_b));
  const double turn_a = std::abs(motion.spin_a), turn_b = std::abs(motion.spin_b);
  const double bend =
      (1.0 + 0x1p-40) * (motion.acceleration + turn_a * turn_a * arm_a + turn_b * turn_b * arm_b);
  if (!(bend < std::numeric_limits<double>::infinity())) return {0.0, 0.0};
  const double moving = dot(gap.offset, motion.velocity) + motion.spin_b * cross(gap.arm_b, gap.offset) -
                        motion.spin_a * cross(gap.arm_a, gap.offset);
  const double slope = moving / distance;
  const double rounding = 0x1p-46 * (motion.speed + turn_a * arm_a + turn_b * arm_b);
  constexpr double kRounding = 1.0 - 0x1p-46;
  return {kRounding * root(height, -slope - rounding, bend),
          kRounding * root(height, slope - rounding, bend)};
}

}  // namespace throng::narrowphase
