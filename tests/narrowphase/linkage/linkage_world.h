// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/linkage/check_linkage.h"
#include "narrowphase/nearest_parts.h"
#include "random_linkage.h"

namespace throng::narrowphase {

/// Robots among obstacles, with all pairs that may not touch.
struct World {
  ShapeStore shapes;
  Linkage linkage;
  const PartsBvh* obstacles = nullptr;
  std::vector<LinkPair> pairs;

  LinkageChecker checker() {
    if (pairs.empty()) pairs = pairs_to_check(linkage, obstacles != nullptr);
    return LinkageChecker({linkage, pairs, obstacles});
  }
  /// The least over all pairs of parts, at one instant of a motion.
  double distance(const LinkPair& pair, const LinkageMotion& motion, double time) const {
    const auto [a, b] = narrowphase::shapes({linkage, pairs, obstacles}, pair);
    return separation(a->parts, motion.pose(pair.a, time), b->parts, motion.pose(pair.b, time)).distance;
  }
};

inline World bar_and_post(double bar, const Vec& post, double radius) {
  World world;
  world.linkage = arm(world.shapes, 1, bar, 0.0);
  world.obstacles = world.shapes.add({disc(radius, post)});
  return world;
}

inline World random_world(Random& random, std::size_t links) {
  World world;
  world.linkage = random_forest(random, world.shapes, links);
  std::vector<Convex> parts;
  while (parts.size() < 12) {
    Convex part = random_shape(random, 0.5);
    const Vec to = random_vec(random, 12.0, 12.0);
    for (Vec& v : part.vertices) v += to;
    parts.push_back(part);
  }
  world.obstacles = world.shapes.add(std::move(parts));
  return world;
}

}  // namespace throng::narrowphase
