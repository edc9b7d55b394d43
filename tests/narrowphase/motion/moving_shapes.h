// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/motion/motion.h"
#include "tests/narrowphase/random_shapes.h"

/// Random convex shapes in random motion, half of which meet.
namespace throng::narrowphase {

struct MovingPairOfShapes {
  Convex a, b;
  Motion motion_a, motion_b;
};

inline Motion random_motion(Random& random, double range, double speed, double spin) {
  const Vec position = random_vec(random, range, range), velocity = random_vec(random, speed, speed);
  const double angle = uniform(random, -4.0, 4.0);
  return {position, angle, velocity, uniform(random, -spin, spin)};
}

/// Discs, segments, polygons, rounded or not, about 1 in size, that start apart and pass each other within
/// about a size from time 0 to 1.
inline MovingPairOfShapes random_motions(Random& random) {
  MovingPairOfShapes p{random_shape(random, 1.0), random_shape(random, 1.0), {}, {}};
  const double spin = random() % 4 == 0 ? 0.0 : 4.0;
  p.motion_a = random_motion(random, 1.0, 1.0, spin), p.motion_b = random_motion(random, 1.0, 1.0, spin);
  const Pose from = pose({0, 0}, uniform(random, -4.0, 4.0));
  const double away = uniform(random, 4.5, 6.0), aside = uniform(random, -3.0, 3.0);
  p.motion_b.position = p.motion_a.position + from.rotate({away, 0.0});
  p.motion_b.velocity = p.motion_a.velocity + from.rotate({-uniform(random, 4.0, 9.0), aside});
  return p;
}

}  // namespace throng::narrowphase
