// SPDX-License-Identifier: MIT
#include "narrowphase/motion/clear_time.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/motion/parabola.h"

namespace throng::narrowphase {

namespace {

/// Shortens `time` to when a vertex comes down.
void shorten(const Parabola& vertex, double& time) {
  if (!(vertex.at(time) >= 0.0)) time = std::min(time, vertex.root());
}

/// Along an axis that turns with the one that stays. What doesn't turn may have its origin anywhere: in that
/// of the other.
ClearTime clear_time(const Standing& stays, double spin, const Standing& moves, double spin_moving,
                     const Vec& normal, const Vec& velocity, const RelativeMotion& motion, double margin,
                     const ClearTime& wanted) {
  const Vec between = moves.pose.position - stays.pose.position, none{0.0, 0.0};
  const bool turns = spin_moving != 0.0;
  const Vec offset = turns ? between : none;
  const Pose about{turns ? none : between, moves.pose.cos, moves.pose.sin};
  double floor = -std::numeric_limits<double>::infinity();
  for (const Vec& v : stays.vertices) floor = std::max(floor, dot(normal, stays.pose.rotate(v)));
  const double distance = length(offset), far = length(about.position) + moves.far;
  const double turn = std::abs(spin), turning = std::abs(spin_moving - spin);
  const auto bend = [&](double reach) {
    const double origins = motion.acceleration + bend_of_origins(spin, motion.speed, distance);
    return (1.0 + 0x1p-40) * (origins + bend_of_vertex(turning, reach));
  };
  const double most = bend(far);
  if (!(most < std::numeric_limits<double>::infinity())) return {0.0, 0.0};
  const double rounding = 0x1p-46 * (motion.speed + turn * distance + turning * far);
  const double height = dot(normal, offset) - floor - margin;
  const double slope = rate_of_origins(normal, spin, velocity, offset);
  ClearTime clear = wanted;
  for (const Vec& v : moves.vertices) {
    const Vec u = about * v;
    const double h = height + dot(normal, u), rising = slope + (spin - spin_moving) * cross(normal, u);
    if (!(h > 0.0)) return {0.0, 0.0};
    const bool near = 4.0 * dot(u, u) < far * far;
    const double bends = near ? bend(length(u)) : most;
    shorten({h, -rising - rounding, bends}, clear.before);
    shorten({h, rising - rounding, bends}, clear.after);
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
  constexpr double kSquaresKeepTheirDigits = 0x1p-960;
  const double squared = dot(gap.offset, gap.offset);
  const double distance = std::sqrt(squared), height = distance - gap.margin;
  if (!(height > 0.0) || !(squared > kSquaresKeepTheirDigits)) return {0.0, 0.0};
  const double arm_a = length(gap.arm_a), arm_b = length(gap.arm_b);
  const double turn_a = std::abs(motion.spin_a), turn_b = std::abs(motion.spin_b);
  const double bend = (1.0 + 0x1p-40) * (motion.acceleration + bend_of_vertex(motion.spin_a, arm_a) +
                                         bend_of_vertex(motion.spin_b, arm_b));
  if (!(bend < std::numeric_limits<double>::infinity())) return {0.0, 0.0};
  const double moving = dot(gap.offset, motion.velocity) + motion.spin_b * cross(gap.arm_b, gap.offset) -
                        motion.spin_a * cross(gap.arm_a, gap.offset);
  const double slope = moving / distance;
  const double rounding = 0x1p-46 * (motion.speed + turn_a * arm_a + turn_b * arm_b);
  constexpr double kRounding = 1.0 - 0x1p-46;
  return {kRounding * Parabola{height, -slope - rounding, bend}.root(),
          kRounding * Parabola{height, slope - rounding, bend}.root()};
}

}  // namespace throng::narrowphase
