// SPDX-License-Identifier: MIT
#include "narrowphase/motion/motion.h"

#include <cmath>

#include "narrowphase/relative.h"

namespace throng::narrowphase {

Pose pose_at(const Motion& motion, double time) {
  return pose(motion.position + time * motion.velocity, motion.angle + time * motion.spin);
}

double pose_rounding(const Motion& motion, double time, double radius) {
  constexpr double kRounding = 0x1p-50;
  const double moved = motion.position.lpNorm<1>() + std::abs(time) * motion.velocity.lpNorm<1>();
  const double turned = 1.0 + std::abs(motion.angle) + std::abs(time * motion.spin);
  return kRounding * (moved + turned * radius);
}

GapRate gap_rate(const Motion& a, const Motion& b) {
  return {direction(b.velocity - a.velocity, {1.0, 0.0}).length, std::abs(a.spin), std::abs(b.spin)};
}

}  // namespace throng::narrowphase
