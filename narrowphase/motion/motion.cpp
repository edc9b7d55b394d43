// SPDX-License-Identifier: MIT
#include "narrowphase/motion/motion.h"

#include <cmath>

#include "narrowphase/relative.h"

namespace throng::narrowphase {

Pose pose_at(const Motion& motion, double time) {
  return pose(motion.position + time * motion.velocity, motion.angle + time * motion.spin);
}

GapRate gap_rate(const Motion& a, const Motion& b) {
  return {direction(b.velocity - a.velocity, {1.0, 0.0}).length, std::abs(a.spin), std::abs(b.spin)};
}

}  // namespace throng::narrowphase
