// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "narrowphase/bvh_parts.h"
#include "narrowphase/motion/motion.h"

/// What `throng bench motion` asks about rigid bodies: all over [0, 1], drawn from a fixed seed.
namespace throng::bench {

/// A union of convex parts and its hierarchy, which stay where they are.
struct Solid {
  std::vector<narrowphase::Convex> parts;
  narrowphase::PartsBvh bvh;

  explicit Solid(std::vector<narrowphase::Convex> of) : parts(std::move(of)), bvh(parts_bvh(parts)) {}
  Solid(const Solid&) = delete;
};

struct MotionQuery {
  const Solid *a, *b;
  narrowphase::Motion motion_a, motion_b;
};

struct MotionCase {
  std::string name;
  double size;  ///< m, what errors are relative to
  bool past;    ///< known to be free by how it was made, with a gap that the name tells
  std::vector<std::unique_ptr<Solid>> solids = {};
  std::vector<MotionQuery> queries = {};

  bool convex() const;
};

/// A bar of 4 m x 0.2 m turns by 4.1 rad about a point of it, so that its short end, of 1 m, passes the flat
/// side of a post that its long end would reach; at its nearest it is `clearance` (m) away, or for a negative
/// one that deep in it.
MotionCase bar_past_post(double clearance, std::size_t queries);

/// Two polygons of eight corners on circles of radius 1, which go up to 4 m and turn up to a radian each;
/// about half of the pairs hit. The same of rods, 2 m x 0.02 m.
MotionCase random_octagons(std::size_t queries);
MotionCase random_rods(std::size_t queries);

/// Two gears, or two coastlines, of `edges` edges, in convex parts: likewise.
MotionCase random_outlines(const std::string& family, std::size_t edges, std::size_t queries);

/// An angle bracket among 400 polygons that stand still: one solid.
MotionCase random_clutter(std::size_t queries);

}  // namespace throng::bench
