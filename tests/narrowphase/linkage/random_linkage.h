// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <numbers>

#include "narrowphase/linkage/linkage_motion.h"
#include "tests/narrowphase/random_shapes.h"

/// Robots for tests, and the bounds of their motion as the textbook has them.
namespace throng::narrowphase {

/// Keeps the shapes of links and obstacles.
struct ShapeStore {
  std::deque<std::vector<Convex>> parts;
  std::deque<PartsBvh> solids;

  const PartsBvh* add(std::vector<Convex> solid) {
    parts.push_back(std::move(solid));
    solids.push_back(parts_bvh(parts.back()));
    return &solids.back();
  }
};

/// Bars from each joint to the next, of which each has length `lengths[i]`; the last ends in the air.
inline Linkage arm(ShapeStore& shapes, std::span<const double> lengths, double radius) {
  Linkage robot;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    Link link;
    link.shape = shapes.add({segment({0, 0}, {lengths[i], 0}, radius)});
    if (i > 0) link.parent = static_cast<std::uint32_t>(i - 1), link.at = {lengths[i - 1], 0};
    robot.push_back(link);
  }
  return robot;
}

inline Linkage arm(ShapeStore& shapes, std::size_t links, double length, double radius) {
  return arm(shapes, std::vector<double>(links, length), radius);
}

/// A forest: a link hangs on the one before it, on any before it or on the world.
inline Linkage random_forest(Random& random, ShapeStore& shapes, std::size_t links) {
  Linkage forest;
  for (std::uint32_t i = 0; i < links; ++i) {
    Link link;
    std::vector<Convex> parts;
    for (std::size_t n = 1 + random() % 3; parts.size() < n;) parts.push_back(random_shape(random, 0.3));
    link.shape = shapes.add(std::move(parts));
    const std::size_t kind = random() % 6;
    if (i > 0 && kind > 0) link.parent = kind > 2 ? i - 1 : static_cast<std::uint32_t>(random() % i);
    link.joint = random() % 3 == 0 ? Joint::prismatic : Joint::revolute;
    link.at = random_vec(random, 2.0, 2.0);
    link.angle = uniform(random, -3.0, 3.0);
    link.axis = pose({0, 0}, uniform(random, -3.0, 3.0)).rotate({1.0, 0.0});
    forest.push_back(link);
  }
  return forest;
}

/// Every so often 0 or the opposite of the one before, so that arms turn as one.
inline std::vector<double> random_values(Random& random, std::size_t links, double size) {
  std::vector<double> values;
  for (std::size_t i = 0; i < links; ++i) {
    const double value = uniform(random, -size, size);
    const std::size_t kind = random() % 5;
    values.push_back(kind == 0 ? 0.0 : kind == 1 && i > 0 ? -values.back() : value);
  }
  return values;
}

inline double reach(const Link& link) {
  return link.shape->tree.root().centre.norm() + link.shape->tree.root().radius;
}

/// The longest that the arm to a link gets on a straight way between two values. m.
inline double longest_arm(const Link& link, double from, double to) {
  if (link.joint == Joint::revolute) return link.at.norm();
  return std::max((link.at + from * link.axis).norm(), (link.at + to * link.axis).norm());
}

/// What each joint between `link` and its ancestor `top` moves a point `radius` from the link's origin at
/// most, summed: the definition that is never sharper. m.
inline double textbook(const Linkage& linkage, std::uint32_t link, std::uint32_t top, double radius,
                       std::span<const double> from, std::span<const double> to) {
  double sum = 0.0;
  for (double lever = radius; link != top; link = linkage[link].parent) {
    const double change = std::abs(to[link] - from[link]);
    sum += linkage[link].joint == Joint::revolute ? change * lever : change;
    lever += longest_arm(linkage[link], from[link], to[link]);
  }
  return sum;
}

}  // namespace throng::narrowphase
