// SPDX-License-Identifier: MIT
#pragma once

#include "../polygons.h"
#include "narrowphase/decompose.h"
#include "narrowphase/motion/motion.h"

/// Solids in motion for tests against the definition.
namespace throng::narrowphase {

/// A disc, a capsule, a segment, a convex polygon, some of each, or a polygon that isn't convex.
inline std::vector<Convex> random_solid(Random& random) {
  const auto kind = random() % 4;
  if (kind == 0) return decompose(random_simple(random, 12), random() % 2 ? 0.05 : 0.0);
  std::vector<Convex> parts;
  for (std::size_t n = kind == 1 ? 1 + random() % 6 : 1; parts.size() < n;)
    parts.push_back(scaled(random_shape(random, 1.0), 0.5));
  return parts;
}

/// From some metres away past the origin, or turning there; also slow, or without a turn.
inline Motion random_motion(Random& random) {
  const Vec middle = random_vec(random, 1.6, 1.6);
  const double speed = random() % 4 == 0 ? 0.0 : std::pow(10.0, uniform(random, -2, 0.6));
  const Vec velocity = random_vec(random, speed, speed);
  const double angle = uniform(random, -4, 4);
  const double spin =
      random() % 3 == 0 ? 0.0 : std::pow(10.0, uniform(random, -2, 1)) * (random() % 2 ? 1 : -1);
  return {middle - 0.5 * velocity, angle, velocity, spin};
}

/// The same way from its end to its beginning, in `duration`.
inline Motion reversed(const Motion& motion, double duration) {
  return {motion.position + duration * motion.velocity, motion.angle + duration * motion.spin,
          -motion.velocity, -motion.spin};
}

/// The whole plane turned by `angle` and shifted.
inline Motion moved(const Motion& motion, double angle, const Vec& shift) {
  const Pose turn = pose(shift, angle);
  return {turn * motion.position, motion.angle + angle, turn.rotate(motion.velocity), motion.spin};
}

}  // namespace throng::narrowphase
