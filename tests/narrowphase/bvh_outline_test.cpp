// SPDX-License-Identifier: MIT
#include "narrowphase/bvh_outline.h"

#include <gtest/gtest.h>

#include "narrowphase/bvh_edges.h"
#include "narrowphase/bvh_exhaustive.h"
#include "polygons.h"
#include "tests/less_when_watched.h"
#include "tools/bench/outlines.h"

namespace throng::narrowphase {
namespace {

using bench::Ring;
using Rings = std::vector<Ring>;

Rings scaled(Rings rings, double factor, const Vec& offset = {0, 0}) {
  for (Ring& ring : rings)
    for (Vec& v : ring) v = factor * v + offset;
  return rings;
}

/// `middle` far below the plane's curve: a solid with a hole of `inner`'s shape.
Rings with_hole(const std::vector<double>& inner) {
  return {bench::around(std::vector<double>(64, 3.0)), bench::around(inner)};
}

template <class Volume>
class OutlineOf : public ::testing::Test {};
using PlanarVolumes = ::testing::Types<Ball<2>, Box<2>, OrientedBox<2>, BoxAndBall<2>>;
TYPED_TEST_SUITE(OutlineOf, PlanarVolumes);

TYPED_TEST(OutlineOf, SquaresIsAsFarAsOnPaper) {
  const auto a = outline<TypeParam>(Rings{square(1.0)});
  const OutlineProximity apart = proximity(a, Pose{{0, 0}}, a, Pose{{5, 6}});
  EXPECT_EQ(apart.lower, 5.0);
  EXPECT_EQ(apart.upper, 5.0);
  EXPECT_EQ(apart.point_a, Vec(1, 1));
  EXPECT_EQ(apart.point_b, Vec(4, 5));
  EXPECT_FALSE(collide(a, Pose{{0, 0}}, a, Pose{{5, 6}}));
  for (const Vec& touching : {Vec(2, 2), Vec(2, 0.5), Vec(-2, 0), Vec(0, -2)}) {
    EXPECT_EQ(proximity(a, Pose{{0, 0}}, a, Pose{touching}).upper, 0.0);
    EXPECT_TRUE(collide(a, Pose{{0, 0}}, a, Pose{touching}));
  }
}

TYPED_TEST(OutlineOf, ASolidHoldsWhatLiesInsideIt) {
  const auto large = outline<TypeParam>(Rings{square(5.0)}), small = outline<TypeParam>(Rings{square(1.0)});
  const OutlineProximity inside = proximity(large, Pose{}, small, Pose{{1, 0}});
  EXPECT_EQ(inside.upper, -4.0);  // its corners, 4 below the top
  EXPECT_LE(inside.lower, -5.0);  // to the right, no less parts them
  EXPECT_GE(inside.lower, -8.0);
  EXPECT_TRUE(collide(large, Pose{}, small, Pose{{1, 0}}));
  EXPECT_TRUE(collide(small, Pose{{1, 0}}, large, Pose{}, {Order::best_first}));
}

TYPED_TEST(OutlineOf, AHoleIsNotInside) {
  const auto frame = outline<TypeParam>(Rings{square(5.0), square(3.0)});
  const auto small = outline<TypeParam>(Rings{square(1.0)});
  EXPECT_EQ(proximity(frame, Pose{}, small, Pose{{0.5, 0}}).upper, 1.5);
  EXPECT_FALSE(collide(frame, Pose{}, small, Pose{{0.5, 0}}));
  EXPECT_TRUE(collide(frame, Pose{}, small, Pose{{4, 0}}));
  EXPECT_TRUE(contains(frame, Vec(4, 0)));
  EXPECT_FALSE(contains(frame, Vec(2.9, 0)));
  EXPECT_FALSE(contains(frame, Vec(6, 0)));
}

TYPED_TEST(OutlineOf, CrossingBarsHaveNoDeepVertex) {
  const auto bar = outline<TypeParam>(Rings{{{-5, -1}, {5, -1}, {5, 1}, {-5, 1}}});
  const OutlineProximity cross = proximity(bar, Pose{}, bar, Pose{{0, 0}, 0.0, 1.0});
  EXPECT_EQ(cross.upper, 0.0);
  EXPECT_LE(cross.lower, -2.0);
  EXPECT_EQ(cross.point_a, cross.point_b);
}

/// Two polygons, and how large their coordinates are.
struct Case {
  std::string family;
  Rings a, b;
  Pose pose_a, pose_b;
  double scale = 1.0;
};

Ring random_ring(Random& random) {
  const std::size_t edges = std::size_t{8} << random() % 5;
  const std::size_t kind = random() % 5;
  if (kind == 0) return bench::around(bench::star_radii(edges));
  if (kind == 1) return bench::around(bench::gear_radii(edges));
  if (kind == 2) return bench::around(bench::coast_radii(edges, random()));
  if (kind == 3) return spiral(40, 2);
  return random_simple(random, 3 + static_cast<int>(random() % 60));
}

/// Apart by chance, nearly touching, interlocked with a hole, one in the other, on a grid where things touch.
Case random_case(Random& random, std::size_t trial) {
  Case c;
  c.a = {random_ring(random)};
  c.b = {random_ring(random)};
  const Vec at = random_vec(random, 5.0, 5.0);
  c.pose_a = pose(at, uniform(random, -4, 4));
  c.pose_b = pose(at + random_vec(random, 3.0, 3.0), uniform(random, -4, 4));
  const std::size_t family = trial % 5;
  if (family == 0) c.family = "by chance";
  if (family == 1) {
    c.family = "interlocked";
    const auto radii = bench::coast_radii(std::size_t{16} << random() % 4, random());
    const double turn = uniform(random, -4, 4);
    c.a = {bench::around(radii)};
    c.b = with_hole(bench::widened(radii, uniform(random, -0.01, 0.05)));
    for (Ring& ring : c.b) ring = bench::turned(ring, turn);
    c.pose_b = pose(at, -turn);
    c.pose_a = pose(at, 0.0);
  }
  if (family == 2) {
    c.family = "contained";
    c.b = scaled(c.b, uniform(random, 0.001, 0.2));
    c.pose_b.position = at + random_vec(random, 0.3, 0.3);
  }
  if (family == 3) {
    c.family = "on a grid";
    c.a = {{{0, 0}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}};
    c.b = {{{0, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}};
    c.pose_a = Pose{{0, 0}};
    c.pose_b = Pose{{static_cast<double>(random() % 11) - 4, static_cast<double>(random() % 11) - 4}};
    if (random() % 2) c.pose_b.cos = 0.0, c.pose_b.sin = 1.0;
  }
  if (family == 4) {
    c.family = "scaled and far";
    c.scale = std::pow(10.0, uniform(random, -6, 6));
    const Vec inner = trial % 2 ? Vec(1e6 * c.scale, -1e6 * c.scale) : Vec(0, 0);
    c.a = scaled(c.a, c.scale, inner), c.b = scaled(c.b, c.scale, inner);
    c.pose_a.position *= c.scale, c.pose_b.position *= c.scale;
    const Vec offset = trial % 4 < 2 ? Vec(0, 0) : Vec(1e6 * c.scale, 1e6 * c.scale);
    c.pose_a.position += offset - c.pose_a.rotate(inner),
        c.pose_b.position += offset - c.pose_b.rotate(inner);
    if (trial % 4 != 0) c.scale *= 1e6;
  }
  return c;
}

TYPED_TEST(OutlineOf, TwoPolygonsIsWhatAllEdgesAgainstAllSay) {
  Random random(20261121);
  constexpr std::size_t kTrials = less_when_watched(1500);
  std::size_t overlapping = 0;
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    const Case c = random_case(random, trial);
    SCOPED_TRACE(c.family + " " + std::to_string(trial));
    const BvhConfig config{trial % 2 ? Split::sah : Split::middle, 1 + static_cast<std::uint32_t>(trial % 5)};
    const auto a = outline<TypeParam>(c.a, config), b = outline<TypeParam>(c.b, config);
    const auto of_a = outline_edges(c.a), of_b = outline_edges(c.b);
    const OutlineProximity expected = exhaustive_proximity(of_a, c.pose_a, of_b, c.pose_b);
    OutlineCache cache{static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random())};
    const OutlineProximity found = proximity(a, c.pose_a, b, c.pose_b, {0.0, &cache});
    const double rounding = 1e-14 * c.scale;
    EXPECT_NEAR(found.upper, expected.upper, rounding);
    EXPECT_NEAR((found.point_b - found.point_a).norm(), std::abs(found.upper), rounding);
    EXPECT_LE(found.lower, found.upper);
    EXPECT_TRUE(found.upper <= 0.0 || found.lower == found.upper);
    const bool touching = std::abs(expected.upper) <= rounding && c.family != "on a grid";
    const bool collides = collide(a, c.pose_a, b, c.pose_b);
    if (!touching) {
      EXPECT_EQ(found.upper <= 0.0, expected.lower <= 0.0);
      EXPECT_EQ(collides, expected.lower <= 0.0);
    }
    EXPECT_EQ(collides, found.upper <= 0.0);
    EXPECT_EQ(collides, collide(a, c.pose_a, b, c.pose_b, {Order::best_first}));
    overlapping += collides;
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(collides, collide(a, c.pose_a, b, c.pose_b, {Order::depth_first, &cache}));
    }

    const OutlineProximity again = proximity(a, c.pose_a, b, c.pose_b, {0.0, &cache});
    EXPECT_EQ(again.upper, found.upper);
    OutlineCache swapped_cache;
    const OutlineProximity swapped = proximity(b, c.pose_b, a, c.pose_a, {0.0, &swapped_cache});
    EXPECT_EQ(swapped.upper, found.upper);
    EXPECT_EQ(swapped.lower, found.lower);
    if (found.upper > 0.0) {
      EXPECT_FALSE(collide(b, c.pose_b, a, c.pose_a));
      EXPECT_EQ(a.edges[cache.a].index, again.edge_a);
      EXPECT_EQ(b.edges[swapped_cache.a].index, swapped.edge_a);
      EXPECT_EQ(a.edges[swapped_cache.b].index, swapped.edge_b);
    }
  }
  EXPECT_GT(overlapping, 3 * kTrials / 10);
  EXPECT_LT(overlapping, 26 * kTrials / 30);
}

/// Where edges met, the next step is asked of these alone.
TYPED_TEST(OutlineOf, ACollisionIsFoundWhereItWas) {
  const auto a = outline<TypeParam>(Rings{bench::around(bench::coast_radii(256, 1))});
  const auto b = outline<TypeParam>(Rings{bench::around(bench::coast_radii(128, 2))});
  OutlineCache cache;
  BvhCounters counters;
  for (const bool swap : {false, true}) {
    const auto ask = [&](const Vec& at) {
      const CollisionQuestion question{Order::depth_first, &cache, &counters};
      return swap ? collide(a, Pose{}, b, Pose{at}, question) : collide(b, Pose{at}, a, Pose{}, question);
    };
    cache = {};
    EXPECT_TRUE(ask({1.0, 0.2}));
    counters = {};
    EXPECT_TRUE(ask({1.0, 0.2}));
    EXPECT_TRUE(ask({1.0, 0.2 + 1e-6}));
    EXPECT_EQ(counters.nodes, 0u);
    EXPECT_FALSE(ask({3.0, 0.2}));
    EXPECT_GT(counters.nodes, 0u);
  }
}

TYPED_TEST(OutlineOf, TwoPolygonsMeetsWhereAllEdgesAgainstAllSay) {
  Random random(3);
  std::size_t met = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::size_t trial = 0; trial < 500; ++trial) {
    const Case c = random_case(random, trial);
    const auto a = outline<TypeParam>(c.a), b = outline<TypeParam>(c.b);
    find_meetings(a, c.pose_a, b, c.pose_b, found);
    const auto of_a = outline_edges(c.a), of_b = outline_edges(c.b);
    auto other_frame = exhaustive_meetings(of_b, c.pose_b, of_a, c.pose_a);
    for (auto& [i, j] : other_frame) std::swap(i, j);
    std::sort(other_frame.begin(), other_frame.end());
    const auto expected = exhaustive_meetings(of_a, c.pose_a, of_b, c.pose_b);
    EXPECT_TRUE(found == expected || found == other_frame) << c.family << trial;
    met += found.size();
  }
  EXPECT_GT(met, 1000u);
}

TYPED_TEST(OutlineOf, APolygonIsNoFartherFromAPointThanAllEdgesSay) {
  Random random(9);
  int inside = 0;
  for (std::size_t trial = 0; trial < 300; ++trial) {
    const Case c = random_case(random, trial);
    const auto shape = outline<TypeParam>(c.a);
    const auto edges = outline_edges(c.a);
    OutlineCache cache;
    for (int i = 0; i < 40; ++i) {
      Vec at = c.a[0][random() % c.a[0].size()];
      if (i % 4 != 0) at += c.pose_a.rotate(random_vec(random, 0.5, 0.5) * (c.a[0][0] - c.a[0][1]).norm());
      const OutlinePoint expected = exhaustive_nearest(edges, at);
      const OutlinePoint found = nearest(shape, at, i % 2 ? &cache : nullptr);
      EXPECT_EQ(found.distance, expected.distance) << c.family;
      EXPECT_EQ(contains(shape, at), exhaustive_contains(edges, at)) << c.family;
      inside += contains(shape, at);
    }
  }
  EXPECT_GT(inside, 3000);
  EXPECT_LT(inside, 9000);
}

/// What is asked for is given: upper <= (1 + a) lower, and the exact distance lies between the two.
TYPED_TEST(OutlineOf, AnApproximateDistanceKeepsItsPromise) {
  Random random(10);
  int cheaper = 0, loose = 0;
  for (std::size_t trial = 0; trial < 600; ++trial) {
    const Case c = random_case(random, trial);
    const auto a = outline<TypeParam>(c.a), b = outline<TypeParam>(c.b);
    const OutlineProximity exact = proximity(a, c.pose_a, b, c.pose_b);
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (const double error : {0.0, 0.01, 0.1, 0.5, 1.0}) {
      BvhCounters counters;
      const OutlineProximity found = proximity(a, c.pose_a, b, c.pose_b, {error, nullptr, &counters});
      if (exact.upper <= 0.0) {
        EXPECT_EQ(found.upper, exact.upper);
        continue;
      }
      EXPECT_LE(found.lower, exact.upper);
      EXPECT_GE(found.upper, exact.upper);
      EXPECT_LE(found.upper, (1.0 + error) * found.lower * (1.0 + 1e-15));
      EXPECT_GT(counters.nodes, 0u);
      cheaper += counters.nodes < before;
      before = counters.nodes;
      loose += found.upper > exact.upper;
    }
  }
  EXPECT_GT(cheaper, 600);
  EXPECT_GT(loose, 50);
}

TYPED_TEST(OutlineOf, AMillionEdgesInARowNeedsNoDeepTree) {
  Ring spread;  // each vertex half as far out as the one before, then a fine line
  for (int i = 0; i < 300; ++i) spread.emplace_back(std::ldexp(1.0, -i), std::ldexp(0.1, -2 * i));
  for (int i = 0; i < 3000; ++i) spread.emplace_back(0.0, -1e-9 * (i + 1));
  for (const Split how : {Split::middle, Split::sah}) {
    const auto shape = outline<TypeParam>(Rings{spread}, {how, 1});
    std::vector<std::size_t> depth(shape.tree.nodes.size(), 0);
    std::size_t deepest = 0, leaves = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const Branch branch = shape.tree.nodes[i].branch;
      deepest = std::max(deepest, depth[i]);
      leaves += branch.count;
      if (branch.count == 0) depth[branch.first] = depth[branch.first + 1] = depth[i] + 1;
    }
    EXPECT_EQ(leaves, spread.size());
    EXPECT_LE(deepest, kDeepestBvh);
    EXPECT_EQ(nearest(shape, Vec(0.25, 0.5)).distance,
              exhaustive_nearest(outline_edges(Rings{spread}), Vec(0.25, 0.5)).distance);
  }
}

TEST(Edges, AreAsFarApartAsOnPaper) {
  EXPECT_EQ(nearest_of_edges({0, 0}, {4, 0}, {1, 3}, {1, 5}).squared, 9.0);
  EXPECT_EQ(nearest_of_edges({0, 0}, {4, 0}, {7, 4}, {9, 4}).squared, 25.0);
  EXPECT_EQ(nearest_of_edges({0, 0}, {4, 0}, {7, 4}, {9, 4}).on_a, Vec(4, 0));
  EXPECT_EQ(nearest_of_edges({0, 0}, {4, 4}, {0, 4}, {4, 0}).squared, 0.0);
  EXPECT_EQ(nearest_of_edges({0, 0}, {4, 4}, {0, 4}, {4, 0}).on_a, Vec(2, 2));
  EXPECT_EQ(nearest_of_edges({0, 0}, {4, 0}, {2, 0}, {6, 0}).squared, 0.0);
  EXPECT_TRUE(ray_passes({0, 0}, {1, -1}, {1, 1}));
  EXPECT_FALSE(ray_passes({0, 0}, {1, 0}, {1, -1}));  // its upper end on the ray is left out ...
  EXPECT_TRUE(ray_passes({0, 0}, {1, 0}, {1, 1}));    // ... and its lower end counts
  EXPECT_FALSE(ray_passes({2, 0}, {1, -1}, {1, 1}));
}

}  // namespace
}  // namespace throng::narrowphase
