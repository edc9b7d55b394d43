// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "narrowphase/motion/first_contact.h"
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

inline Convex shifted(const Convex& shape, const Vec& by) {
  std::vector<Vec> vertices = shape.vertices;
  for (Vec& v : vertices) v += by;
  return convex(std::move(vertices), shape.radius);
}

/// One swings about an origin metres from its vertices, past the other, which doesn't turn and whose origin
/// is as far from its own, often near the first one's.
inline MovingPairOfShapes random_swing(Random& random) {
  const double arm = uniform(random, 2.0, 5.0), away = arm + uniform(random, -1.2, 1.2);
  const Vec shift = random_vec(random, arm, arm);
  const Convex swings = scaled(random_shape(random, 1.0), 0.5),
               stays = scaled(random_shape(random, 1.0), 0.5);
  MovingPairOfShapes p{shifted(swings, {arm, 0.0}), shifted(stays, shift), {}, {}};
  p.motion_a = random_motion(random, 1.0, 1.0, 0.0);
  p.motion_a.spin = uniform(random, 1.0, 4.0) * (random() % 2 ? 1.0 : -1.0);
  const double ahead = uniform(random, 0.7, 2.2) * (p.motion_a.spin > 0.0 ? 1.0 : -1.0);
  p.motion_b = {{0.0, 0.0}, uniform(random, -4.0, 4.0), p.motion_a.velocity, 0.0};
  const Vec place = p.motion_a.position + pose({0, 0}, p.motion_a.angle + ahead).rotate({away, 0.0});
  p.motion_b.position = place - pose({0, 0}, p.motion_b.angle).rotate(shift);
  if (random() % 2) p.motion_b.velocity += random_vec(random, 0.5, 0.5);
  if (random() % 2) std::swap(p.a, p.b), std::swap(p.motion_a, p.motion_b);
  return p;
}

/// Discs, segments, polygons, rounded or not, about 1 in size, that start apart and pass each other within
/// about a size from time 0 to 1; of every fourth pair one swings.
inline MovingPairOfShapes random_motions(Random& random) {
  if (random() % 4 == 0) return random_swing(random);
  MovingPairOfShapes p{random_shape(random, 1.0), random_shape(random, 1.0), {}, {}};
  const double spin = random() % 4 == 0 ? 0.0 : 4.0;
  p.motion_a = random_motion(random, 1.0, 1.0, spin), p.motion_b = random_motion(random, 1.0, 1.0, spin);
  const Pose from = pose({0, 0}, uniform(random, -4.0, 4.0));
  const double away = uniform(random, 4.5, 6.0), aside = uniform(random, -3.0, 3.0);
  p.motion_b.position = p.motion_a.position + from.rotate({away, 0.0});
  p.motion_b.velocity = p.motion_a.velocity + from.rotate({-uniform(random, 4.0, 9.0), aside});
  return p;
}

/// Two brackets of one moment.
inline void expect_same_contact(const FirstContact& found, const FirstContact& expected, double tolerance) {
  EXPECT_EQ(found.verdict, expected.verdict);
  EXPECT_LE(found.t_lo, expected.t_hi + tolerance);
  EXPECT_GE(found.t_hi, expected.t_lo - tolerance);
}

}  // namespace throng::narrowphase
