// SPDX-License-Identifier: MIT
#include "narrowphase/bvh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "narrowphase/bvh_traverse.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

/// Clouds of points in space: a sheet, a heap, and many in one place.
Points<3> cloud(Random& random, std::size_t count) {
  Points<3> points;
  const std::size_t kind = random() % 3;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = uniform(random, -1, 1), y = uniform(random, -1, 1), z = uniform(random, -1, 1);
    points.emplace_back(x, y, kind == 0 ? 0.0 : z);
    if (kind == 2 && i % 2 == 1) points.back() = points.front();
  }
  return points;
}

template <class Volume>
Bvh<Volume> tree_of(const Points<3>& points, const BvhConfig& config) {
  std::vector<Thing<3>> things;
  for (const Point<3>& p : points) things.push_back({p, p});
  return build_bvh<Volume>(
      things, [&](std::uint32_t i, Points<3>& out) { out.push_back(points[i]); }, config);
}

template <class Volume>
class BvhInSpace : public ::testing::Test {};
using SpatialVolumes = ::testing::Types<Ball<3>, Box<3>, OrientedBox<3>, BoxAndBall<3>>;
TYPED_TEST_SUITE(BvhInSpace, SpatialVolumes);

TYPED_TEST(BvhInSpace, FindsTheNearestPointsOfTwoCloudsAndAllThatAreClose) {
  Random random(20261121);
  int skipped = 0;
  for (std::size_t trial = 0; trial < 300; ++trial) {
    const Points<3> a = cloud(random, 1 + random() % 200), b = cloud(random, 1 + random() % 200);
    const BvhConfig config{trial % 2 ? Split::sah : Split::middle, 1 + static_cast<std::uint32_t>(trial % 4)};
    const auto tree_a = tree_of<TypeParam>(a, config), tree_b = tree_of<TypeParam>(b, config);
    const Point<3> axis = Point<3>(uniform(random, -1, 1), uniform(random, -1, 1), 0.5).normalized();
    const Rotation<3> turn = Eigen::AngleAxisd(uniform(random, -3, 3), axis).toRotationMatrix();
    const Point<3> shift(uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2));
    const Frame<3> place = frame<3>(turn, shift, tree_a.reach + tree_b.reach);
    const auto distance = [&](std::size_t i, std::size_t j) { return (turn * b[j] + shift - a[i]).norm(); };
    double expected = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) expected = std::min(expected, distance(i, j));

    BvhCounters counters;
    double upper = std::numeric_limits<double>::infinity();
    const auto leaf = [&](const Branch& of_a, const Branch& of_b, double least) {
      for (std::size_t k = of_a.first; k < of_a.first + of_a.count; ++k)
        for (std::size_t l = of_b.first; l < of_b.first + of_b.count; ++l)
          least = std::min(least, distance(tree_a.order[k], tree_b.order[l]));
      return least;
    };
    EXPECT_EQ(minimise(tree_a, tree_b, place, 0.0, 0.0, upper, leaf, counters), expected);
    EXPECT_EQ(upper, expected);
    skipped += counters.leaves * config.leaf * config.leaf < a.size() * b.size() / 2;
  }
  EXPECT_GT(skipped, 150);
}

/// Every cloud meets itself in every point, in both orders of the walk.
TYPED_TEST(BvhInSpace, MeetsItselfInEveryPoint) {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Points<3> points = cloud(random, 1 + random() % 100);
    const auto tree = tree_of<TypeParam>(points, {Split::sah, 2});
    const Frame<3> place = frame<3>(Rotation<3>::Identity(), Point<3>::Zero(), 2 * tree.reach);
    for (const bool greedy : {false, true}) {
      std::vector<int> met(points.size(), 0);
      const auto leaf = [&](const Branch& of_a, const Branch& of_b) {
        for (std::size_t k = of_a.first; k < of_a.first + of_a.count; ++k)
          for (std::size_t l = of_b.first; l < of_b.first + of_b.count; ++l) met[tree.order[k]] += k == l;
        return false;
      };
      NoCounters none;
      EXPECT_FALSE(greedy ? visit_overlaps_best_first(tree, tree, place, leaf, none)
                          : visit_overlaps(tree, tree, place, leaf, none));
      EXPECT_EQ(met, std::vector<int>(points.size(), 1));
    }
  }
}

}  // namespace
}  // namespace throng::narrowphase
