// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <optional>

#include "../polygons.h"
#include "narrowphase/decompose.h"
#include "narrowphase/motion/motion.h"

/// Random motions of every kind that no answer may be wrong about.
namespace throng::narrowphase::soundness {

constexpr double kPi = std::numbers::pi;

struct Body {
  std::vector<Convex> parts;
  Motion motion;
  std::vector<Vec> ring = {};  ///< of a solid that is an outline: the same as the parts
};

/// Two bodies from time 0 to 1.
struct Trial {
  Body a, b;
  double size = 1.0;               ///< m, of the shapes
  double world = 10.0;             ///< m, of the coordinates
  std::optional<double> margin{};  ///< m, by which they are made to pass, or below 0 to meet

  double rounding() const { return 1e-12 * size + 2e-15 * world; }
  /// Below it "undecided" will do.
  double doubtful() const { return 1e-9 * size + 0x1p-42 * world; }
};

inline Convex octagon(Random& random, double radius) {
  std::vector<Vec> vertices;
  for (int i = 0; i < 8; ++i)
    vertices.push_back(pose({0, 0}, 2.0 * kPi * (i + uniform(random, 0.0, 0.7)) / 8.0).rotate({radius, 0.0}));
  return convex(hull(vertices));
}

/// b goes past a, within a size or so: about half of them meet.
inline void set_passing(Random& random, Trial& t, double spin, double far_aside = 2.5) {
  const Pose from = pose({0, 0}, uniform(random, -kPi, kPi));
  const Vec drift = random_vec(random, 1.0, 1.0), home = random_vec(random, 3.0, 3.0);
  const double away = uniform(random, 2.5, 5.0), aside = uniform(random, -far_aside, far_aside);
  const double way = uniform(random, 2.0, 8.0);
  const double angle_a = uniform(random, -kPi, kPi), angle_b = uniform(random, -kPi, kPi);
  const double spin_a = uniform(random, -spin, spin), spin_b = uniform(random, -spin, spin);
  t.a.motion = {home, angle_a, drift, spin_a};
  t.b.motion = {home + from.rotate({away, aside}), angle_b, drift - from.rotate({way, 0.0}), spin_b};
}

inline Trial discs(Random& random) {
  Trial t;
  const double p = uniform(random, 0.1, 1.2), q = uniform(random, 0.1, 1.2);
  const Vec off = random() % 2 ? Vec{0.0, 0.0} : random_vec(random, 0.5, 0.5);
  t.a.parts = {disc(p)}, t.b.parts = {disc(q, off)};
  set_passing(random, t, 3.0);
  return t;
}

inline Trial capsules(Random& random) {
  Trial t;
  for (Body* body : {&t.a, &t.b}) {
    const Vec p = random_vec(random, 1.0, 1.0), q = random_vec(random, 1.0, 1.0);
    body->parts = {segment(p, q, uniform(random, 0.01, 0.4))};
  }
  set_passing(random, t, 3.0);
  return t;
}

inline Trial octagons(Random& random) {
  Trial t;
  t.a.parts = {octagon(random, 1.0)}, t.b.parts = {octagon(random, 1.0)};
  set_passing(random, t, 3.0);
  return t;
}

inline Trial any_convex(Random& random) {
  Trial t;
  t.a.parts = {random_shape(random, 1.0)}, t.b.parts = {random_shape(random, 1.0)};
  set_passing(random, t, 3.0);
  return t;
}

inline Trial unions(Random& random) {
  Trial t;
  for (Body* body : {&t.a, &t.b})
    for (std::size_t parts = 2 + random() % 3; body->parts.size() < parts;) {
      Convex part = random_shape(random, 1.0);
      const Vec by = random_vec(random, 0.8, 0.8);
      for (Vec& v : part.vertices) v = 0.5 * v + by;
      body->parts.push_back(convex(hull(part.vertices), 0.5 * part.radius));
    }
  set_passing(random, t, 3.0);
  return t;
}

inline Trial translations(Random& random) {
  Trial t = random() % 2 ? octagons(random) : unions(random);
  t.a.motion.spin = t.b.motion.spin = 0.0;
  return t;
}

inline Trial rotations(Random& random) {
  Trial t = random() % 2 ? octagons(random) : unions(random);
  t.a.motion.velocity = t.b.motion.velocity = {0.0, 0.0};
  const Pose side = pose({0, 0}, uniform(random, -kPi, kPi));
  t.b.motion.position = t.a.motion.position + side.rotate({uniform(random, 1.5, 2.6), 0.0});
  return t;
}

inline Trial fast_spins(Random& random) {
  Trial t = any_convex(random);
  set_passing(random, t, std::pow(10.0, uniform(random, 1.0, 3.0)), 4.0);
  return t;
}

/// All lengths by a factor.
inline Trial scaled(Trial t, double factor) {
  for (Body* body : {&t.a, &t.b}) {
    for (Convex& part : body->parts) part = scaled(part, factor);
    body->motion.position *= factor, body->motion.velocity *= factor;
  }
  t.size *= factor, t.world *= factor;
  if (t.margin) *t.margin *= factor;
  return t;
}

inline Trial scales(Random& random) {
  Trial t = random() % 2 ? any_convex(random) : unions(random);
  return scaled(std::move(t), std::pow(10.0, uniform(random, -6.0, 6.0)));
}

inline Trial far_away(Random& random) {
  Trial t = random() % 2 ? any_convex(random) : unions(random);
  const double far = std::pow(10.0, uniform(random, 2.0, 6.0));
  const Vec offset = random_vec(random, far, far);
  t.a.motion.position += offset, t.b.motion.position += offset;
  t.world = 2.0 * far;
  return t;
}

/// From 1e-9 to 1, either sign.
inline double margin(Random& random) {
  const double size = std::pow(10.0, uniform(random, -8.7, 0.0));
  return random() % 2 ? size : -0.3 * size;
}

inline void set_elsewhere(Random& random, Trial& t) {
  const double turn = uniform(random, -kPi, kPi);
  const Pose world = pose(random_vec(random, 3.0, 3.0), turn);
  const Vec drift = random_vec(random, 0.5, 0.5);
  for (Body* body : {&t.a, &t.b}) {
    Motion& m = body->motion;
    m = {world * m.position, m.angle + turn, world.rotate(m.velocity) + drift, m.spin};
  }
}

/// The short end of a bar turns past the flat side of a post.
inline Trial grazing_bars(Random& random) {
  Trial t;
  t.margin = margin(random);
  const double from = Vec(1.0, 0.1).norm() + *t.margin, turn = random() % 2 ? 1.0 : -1.0;
  t.a.parts = {convex({{-3.0, -0.1}, {1.0, -0.1}, {1.0, 0.1}, {-3.0, 0.1}})};
  t.b.parts = {convex({{from, -0.5}, {from + 1.0, -0.5}, {from + 1.0, 0.5}, {from, 0.5}})};
  t.a.motion = {{0.0, 0.0}, uniform(random, -1.9, -1.6) * turn, {0.0, 0.0}, 3.5 * turn};
  set_elsewhere(random, t);
  return t;
}

/// Discs and capsules side by side.
inline Trial grazing_rounds(Random& random) {
  Trial t;
  t.margin = margin(random);
  const double p = uniform(random, 0.5, 1.0), q = uniform(random, 0.5, 1.0);
  const double start = uniform(random, 4.0, 6.0);
  t.a.parts = {disc(p)};
  t.b.parts = {random() % 2 ? disc(q) : segment({-0.4, 0.0}, {0.4, 0.0}, q)};
  t.b.motion = {{start, p + q + *t.margin}, 0.0, {-10.0, 0.0}, 0.0};
  if (t.b.parts[0].vertices.size() == 1) t.b.motion.spin = uniform(random, -9.0, 9.0);
  set_elsewhere(random, t);
  return t;
}

/// A corner goes along a wall, straight or while its body turns about it.
inline Trial grazing_corners(Random& random) {
  Trial t;
  t.margin = margin(random);
  t.a.parts = {convex({{-9.0, -1.0}, {9.0, -1.0}, {9.0, 0.0}, {-9.0, 0.0}})};
  t.b.parts = {convex({{0.0, 0.0}, {0.8, 1.0}, {-0.8, 1.0}})};
  t.b.motion = {{-2.0, *t.margin}, -0.4, {uniform(random, 1.0, 4.0), 0.0}, random() % 2 ? 0.8 : 0.0};
  set_elsewhere(random, t);
  return t;
}

/// Polygons that aren't convex, as outlines.
inline Trial outlines(Random& random) {
  Trial t;
  for (Body* body : {&t.a, &t.b}) {
    body->ring = random_simple(random, 12);
    body->parts = decompose(body->ring, 0.0);
  }
  set_passing(random, t, 3.0);
  return t;
}

/// A bar past a post, or a corner along a wall, as outlines.
inline Trial grazing_outlines(Random& random) {
  Trial t = random() % 2 ? grazing_bars(random) : grazing_corners(random);
  for (Body* body : {&t.a, &t.b}) body->ring = body->parts[0].vertices;
  return t;
}

}  // namespace throng::narrowphase::soundness
