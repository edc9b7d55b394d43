// SPDX-License-Identifier: MIT
#include "narrowphase/nearest_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace throng::narrowphase {
namespace {

/// The definition: all parts against all.
double least(const std::vector<Convex>& a, const Pose& pose_a, const std::vector<Convex>& b,
             const Pose& pose_b) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Convex& part_a : a)
    for (const Convex& part_b : b)
      distance = std::min(distance, separation(part_a, pose_a, part_b, pose_b).distance);
  return distance;
}

std::vector<Convex> discs(std::mt19937_64& random, std::size_t count) {
  std::uniform_real_distribution<double> place(-3.0, 3.0), radius(0.01, 0.5);
  std::vector<Convex> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = place(random), y = place(random);
    result.push_back(i % 2 ? disc(radius(random), {x, y}) : segment({x, y}, {x + 0.3, y + radius(random)}));
  }
  return result;
}

TEST(NearestParts, AreThoseThatAllPairsOfPartsHave) {
  std::mt19937_64 random(20261121);
  std::uniform_real_distribution<double> place(-4.0, 4.0), angle(-3.0, 3.0);
  int overlapping = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto a = discs(random, 1 + trial % 9), b = discs(random, 1 + trial % 7);
    const double x = place(random), y = place(random);
    const Pose pose_a = pose({x, y}, angle(random)), pose_b = pose({x + 0.5 * y, y}, angle(random));
    const double expected = least(a, pose_a, b, pose_b);
    EXPECT_EQ(separation(a, pose_a, b, pose_b).distance, expected) << trial;
    overlapping += expected < 0.0;
  }
  EXPECT_GT(overlapping, 300);
  EXPECT_LT(overlapping, 1700);
}

/// Bounds in world coordinates once hid the nearest part where the coordinates had no digits left for it.
TEST(NearestParts, AreFoundFarFromTheOrigin) {
  const std::vector<Convex> a{disc(1.0)};
  for (const double far : {0.0, 1e9, 1e12, 1e16})
    for (const double nearer : {0.5, 3e-8}) {
      const std::vector<Convex> b{disc(1.0, {3.0 + nearer, 0.0}), disc(1.0, {3.0, 0.0})};
      EXPECT_EQ(separation(a, Pose{{far, 0.0}}, b, Pose{{far, 0.0}}).distance, 1.0) << far << ' ' << nearer;
    }
}

}  // namespace
}  // namespace throng::narrowphase
