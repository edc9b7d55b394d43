// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_parts.h"

#include <gtest/gtest.h>

#include "narrowphase/decompose.h"
#include "narrowphase/nearest_parts.h"
#include "polygons.h"
#include "tools/bench/outlines.h"

namespace throng::narrowphase {
namespace {

std::vector<Convex> parts(Random& random, std::size_t trial) {
  if (trial % 3 == 0) return decompose(random_simple(random, 30), trial % 2 ? 0.05 : 0.0);
  std::vector<Convex> result;
  for (std::size_t i = 0; i < 1 + trial % 40; ++i) {
    const Vec at = random_vec(random, 3, 3);
    if (trial % 3 == 1) result.push_back(disc(uniform(random, 0.01, 0.5), at));
    if (trial % 3 == 2) result.push_back(segment(at, at + random_vec(random, 0.5, 0.5), 0.1 * (i % 2)));
  }
  return result;
}

TEST(PartsBvh, SaysWhatAllPairsOfPartsSay) {
  Random random(20261121);
  int overlapping = 0;
  for (std::size_t trial = 0; trial < 3000; ++trial) {
    const double far = trial % 2 ? 0.0 : 1e6;
    const auto a = parts(random, trial), b = parts(random, random());
    const Vec at = random_vec(random, 5.0, 5.0) + Vec(far, far);
    const Pose pose_a = pose(at, uniform(random, -4, 4));
    const Pose pose_b = pose(at + random_vec(random, 6.0, 6.0), uniform(random, -4, 4));
    const Separation expected = separation(a, pose_a, b, pose_b);
    const Separation found =
        separation(parts_bvh(a, {Split::sah, 2}), pose_a, parts_bvh(b, {Split::middle, 3}), pose_b);
    EXPECT_EQ(found.distance, expected.distance) << trial;
    EXPECT_EQ(found.normal, expected.normal) << trial;
    EXPECT_EQ(found.point_a, expected.point_a) << trial;
    overlapping += found.distance < 0.0;
  }
  EXPECT_GT(overlapping, 700);
  EXPECT_LT(overlapping, 2300);
}

/// Equal discs on a line, all as far from a wall: the first in order answers, whatever the tree's order.
TEST(PartsBvh, OfSeveralNearestTakesTheFirst) {
  std::vector<Convex> row;
  for (int i = 0; i < 50; ++i) row.push_back(disc(0.25, {static_cast<double>((i * 7) % 50), 0.0}));
  const std::vector<Convex> wall{segment({-10, 2}, {60, 2})};
  const Separation s = separation(parts_bvh(row, {Split::sah, 1}), Pose{}, parts_bvh(wall), Pose{});
  EXPECT_EQ(s.distance, 1.75);
  EXPECT_EQ(s.point_a, Vec(0.0, 0.25));
}

/// Of a hundred thousand pairs few are looked at.
TEST(PartsBvh, LooksAtFewPairs) {
  Random random(2);
  std::vector<Convex> a;
  for (int i = 0; i < 300; ++i) a.push_back(disc(0.01, random_vec(random, 1, 1)));
  BvhCounters counters;
  const PartsBvh tree = parts_bvh(a);
  EXPECT_GT(separation(tree, Pose{}, tree, Pose{{2.5, 0.5}}, &counters).distance, 0.4);
  EXPECT_GT(counters.leaves, 0u);
  EXPECT_LT(counters.leaves, 60u);
}

TEST(PartsBvh, KeepsThePromiseOfARoughDistance) {
  Random random(21);
  int apart = 0, saved = 0;
  for (std::size_t trial = 0; trial < 2000; ++trial) {
    const auto a = parts(random, trial), b = parts(random, random());
    const PartsBvh tree_a = parts_bvh(a), tree_b = parts_bvh(b);
    const Pose there = pose(random_vec(random, 9.0, 9.0), uniform(random, -4, 4));
    BvhCounters all, some;
    const double exact = separation(tree_a, Pose{}, tree_b, there, &all).distance;
    const double error = std::array{0.01, 0.1, 1.0}[trial % 3];
    const RoughSeparation rough = rough_separation(tree_a, Pose{}, tree_b, there, error, &some);
    if (exact <= 0.0) {
      EXPECT_EQ(rough.separation.distance, exact) << trial;
      EXPECT_EQ(rough.lower, exact) << trial;
      continue;
    }
    EXPECT_LE(rough.lower, exact) << trial;
    EXPECT_GE(rough.separation.distance, exact) << trial;
    EXPECT_LE(rough.separation.distance, (1.0 + error) * rough.lower * (1.0 + 1e-15)) << trial;
    EXPECT_LE(some.leaves, all.leaves + 8) << trial;
    ++apart;
    saved += some.nodes < all.nodes;
  }
  EXPECT_GT(apart, 700);
  EXPECT_LT(apart, 1800);
  EXPECT_GT(saved, apart / 4);
}

/// Steps small and large, so that what is remembered is nearly right, or wrong, or of other shapes.
TEST(PartsBvh, RemembersWhereAPairWasWithoutBeingMisled) {
  Random random(4);
  int overlapping = 0;
  PartsMemory memory;
  for (std::size_t trial = 0; trial < 200; ++trial) {
    const auto a = parts(random, trial), b = parts(random, random());
    const PartsBvh tree_a = parts_bvh(a, {Split::sah, 1}), tree_b = parts_bvh(b, {Split::sah, 2});
    Vec at = random_vec(random, 6.0, 6.0);
    double angle = uniform(random, -4, 4);
    for (int step = 0; step < 30; ++step) {
      const double size = step % 10 == 9 ? 1.0 : 0.01;
      at += size * random_vec(random, 1.0, 1.0);
      angle += size * uniform(random, -1, 1);
      const Separation found = track(tree_a, Pose{}, tree_b, pose(at, angle), memory);
      const Separation expected = separation(a, Pose{}, b, pose(at, angle));
      EXPECT_NEAR(found.distance, expected.distance, 1e-14) << trial;
      EXPECT_NEAR((found.point_b - found.point_a - found.distance * found.normal).norm(), 0.0, 1e-14);
      overlapping += found.distance < 0.0;
    }
  }
  EXPECT_GT(overlapping, 1500);
  EXPECT_LT(overlapping, 4500);
}

/// A gear that turns beside another: nearly all questions are answered by what is remembered.
TEST(PartsBvh, GoesOnWhereItWas) {
  const auto gear = decompose(bench::around(bench::gear_radii(64)));
  const PartsBvh tree = parts_bvh(gear, {Split::sah, 1});
  PartsMemory memory;
  BvhCounters all, some;
  SearchStatistics statistics;
  for (int step = 0; step < 1000; ++step) {
    const Pose turned = pose({2.02, 0.0}, 0.001 * step);
    track(tree, Pose{}, tree, turned, memory, &some, &statistics);
    const std::pair nearest(memory.a, memory.b);
    track(tree, Pose{}, tree, turned, memory);
    EXPECT_EQ(std::pair(memory.a, memory.b), nearest);
    separation(tree, Pose{}, tree, turned, &all);
  }
  EXPECT_LT(some.leaves, all.leaves);
  EXPECT_LT(statistics.cold_starts, static_cast<std::int64_t>(some.leaves / 5));
}

}  // namespace
}  // namespace throng::narrowphase
