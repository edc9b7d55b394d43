// SPDX-License-Identifier: MIT
#include "narrowphase/manifold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "narrowphase/distance.h"
#include "narrowphase/wall.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

constexpr unsigned kSeed = 90210;
constexpr int kPairs = 60000;
constexpr double kUnitRoundoff = 0x1p-53;

const Convex kSquare = convex({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
const Convex kWall = segment({-10, 0}, {10, 0});

Pose at(double x, double y) {
  return {{x, y}};
}

std::set<std::uint32_t> features(const Manifold& m) {
  std::set<std::uint32_t> names;
  for (int i = 0; i < m.count; ++i) names.insert(m.points[static_cast<std::size_t>(i)].feature);
  return names;
}

double least(const Manifold& m) {
  double separation = INFINITY;
  for (int i = 0; i < m.count; ++i)
    separation = std::min(separation, m.points[static_cast<std::size_t>(i)].separation);
  return separation;
}

TEST(ManifoldOf, TwoDiscsIsOnePointMidwayBetweenTheirRims) {
  const Manifold m = manifold(disc(1), at(0, 0), disc(1), at(0, 1.5), 0.0);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.normal, Vec(0, 1));
  EXPECT_EQ(m.points[0].separation, -0.5);
  EXPECT_EQ(m.points[0].point, Vec(0, 0.75));
}

TEST(ManifoldOf, ShapesApartIsEmptyBeyondReachAndOnlyThere) {
  EXPECT_EQ(manifold(disc(1), at(0, 0), disc(1), at(3, 0), 0.9).count, 0);
  EXPECT_EQ(manifold(disc(1), at(0, 0), disc(1), at(3, 0), 1.0).count, 1);
  EXPECT_EQ(manifold(kSquare, at(0, 0), kSquare, at(3, 0), 0.9).count, 0);
  EXPECT_EQ(manifold(kSquare, at(0, 0), kSquare, at(3, 0), 1.0).count, 2);
}

TEST(ManifoldOf, ADiscOnASquareIsOnePointInEitherOrder) {
  const Manifold m = manifold(kSquare, at(0, 0), disc(0.5), at(0.25, 1.25), 0.0);
  const Manifold swapped = manifold(disc(0.5), at(0.25, 1.25), kSquare, at(0, 0), 0.0);
  ASSERT_EQ(m.count, 1);
  ASSERT_EQ(swapped.count, 1);
  EXPECT_EQ(m.normal, Vec(0, 1));
  EXPECT_EQ(m.points[0].separation, -0.25);
  EXPECT_EQ(m.points[0].point, Vec(0.25, 0.875));
  EXPECT_EQ(swapped.normal, Vec(0, -1));
  EXPECT_EQ(swapped.points[0].point, m.points[0].point);
}

TEST(ManifoldOf, TwoSquaresStackedAskewIsTheStretchThatBothCover) {
  const Manifold m = manifold(kSquare, at(0, 0), kSquare, at(0.5, 1.75), 0.0);
  ASSERT_EQ(m.count, 2);
  EXPECT_EQ(m.normal, Vec(0, 1));
  EXPECT_EQ(least(m), -0.25);
  const auto [low, high] = std::minmax(m.points[0].point.x(), m.points[1].point.x());
  EXPECT_EQ(low, -0.5);
  EXPECT_EQ(high, 1.0);
  EXPECT_EQ(m.points[0].point.y(), 0.875);
}

TEST(ManifoldOf, ASquareOnItsCornerIsThatCorner) {
  const double half = std::sqrt(0.5);
  const Manifold m = manifold(kSquare, at(0, 0), kSquare, {{0.25, 2.375}, half, half}, 0.1);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].separation, 1.375 - std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(m.points[0].point.x(), 0.25, 1e-15);
}

TEST(ManifoldOf, TwoCornersFaceToFaceIsOnePointAlongTheirDifference) {
  const Manifold m = manifold(kSquare, at(0, 0), kSquare, at(2.3, 2.4), 0.6);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].separation, 0.5, 1e-15);
  EXPECT_NEAR(m.normal.x(), 0.6, 1e-15);
  EXPECT_NEAR(m.points[0].point.x(), 1.15, 1e-15);
}

TEST(ManifoldOf, ACapsuleOnAFaceTouchesAtBothItsEnds) {
  const Manifold m = manifold(kSquare, at(0, 0), segment({-0.5, 0}, {0.5, 0}, 0.25), at(0, 1.2), 0.0);
  ASSERT_EQ(m.count, 2);
  EXPECT_NEAR(m.points[0].separation, -0.05, 1e-15);
  EXPECT_NEAR(m.points[1].separation, -0.05, 1e-15);
  EXPECT_NEAR(m.points[0].point.y(), 0.975, 1e-15);
}

TEST(ManifoldOf, AWallPushesABodyBackToTheSideOfItsCentre) {
  const Convex triangle = convex({{-1, -0.25}, {1, -0.25}, {0, 2}});
  for (double height : {0.2, 0.01, 1e-12}) {
    EXPECT_EQ(manifold(kWall, at(0, 0), triangle, at(3, height), 0.0).normal, Vec(0, 1)) << height;
    EXPECT_EQ(manifold(triangle, at(3, height), kWall, at(0, 0), 0.0).normal, Vec(0, -1)) << height;
  }
  const Manifold below = manifold(kWall, at(0, 0), triangle, at(3, -0.5), 0.0);
  EXPECT_EQ(below.normal, Vec(0, -1));
  EXPECT_EQ(least(below), -1.5);
}

TEST(ManifoldOf, AWallPushesADiscBackToTheSideOfItsCentre) {
  EXPECT_EQ(manifold(kWall, at(0, 0), disc(1), at(3, 0.01), 0.0).normal, Vec(0, 1));
  EXPECT_EQ(manifold(kWall, at(0, 0), disc(1), at(3, -0.01), 0.0).normal, Vec(0, -1));
}

TEST(ManifoldOf, AWallsEndInABodysFacePushesAlongTheWall) {
  const Manifold m = manifold(kWall, at(0, 0), kSquare, at(10.9, 0.1), 0.0);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.normal, Vec(1, 0));
  EXPECT_NEAR(m.points[0].separation, -0.1, 1e-15);
}

// Two parallel faces trade the role of the reference with each rounding; the names of the points must not.
TEST(ManifoldOf, ARockingSquareKeepsTheNamesOfItsPoints) {
  const auto tilted = [](double angle) {
    return manifold(kSquare, at(0, 0), kSquare, pose({0.25, 1.99}, angle), 0.05);
  };
  const auto names = features(tilted(0.0));
  ASSERT_EQ(names.size(), 2u);
  for (double angle : {1e-3, -1e-3, 1e-9, -1e-9, 1e-16}) EXPECT_EQ(features(tilted(angle)), names) << angle;
}

TEST(ManifoldOf, TwoSquaresNamesItsPointsAlikeWhoeverIsTheReference) {
  const Convex small = convex({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});
  const auto names = features(manifold(kSquare, at(0, 0), small, pose({0.9, 1.49}, 1e-3), 0.05));
  EXPECT_EQ(names.size(), 2u);
  EXPECT_EQ(features(manifold(kSquare, at(0, 0), small, pose({0.9, 1.49}, -1e-3), 0.05)), names);
}

struct Counts {
  int touching = 0, apart = 0;
};

/// The manifold against the exact separation: there exactly where the shapes are within reach, its normal a
/// separating direction, no point deeper than the shapes.
TEST(ManifoldOf, AnyPairAgreesWithTheExactSeparation) {
  Random random(kSeed);
  Counts counts;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    if (is_wall(a.shape) || is_wall(b.shape) || family == "sliver") continue;
    const double reach = 0.05 * scale, tolerance = 16 * kUnitRoundoff * world;
    const Separation s = separation(a.shape, a.pose, b.shape, b.pose);
    const Manifold m = manifold(a.shape, a.pose, b.shape, b.pose, reach);
    if (std::abs(s.distance - reach) <= tolerance) continue;
    ASSERT_EQ(m.count > 0, s.distance < reach) << family << " " << i << " seed " << kSeed;
    ++(m.count > 0 ? counts.touching : counts.apart);
    if (m.count == 0) continue;
    ASSERT_NEAR(m.normal.norm(), 1.0, 8 * kUnitRoundoff);
    ASSERT_LE(least(m), reach);
    if (s.distance > tolerance)
      ASSERT_LE(std::abs(least(m) - s.distance), 0.02 * scale) << family << " " << i << " seed " << kSeed;
    else
      ASSERT_NEAR(least(m), s.distance, tolerance) << family << " " << i << " seed " << kSeed;
  }
  EXPECT_GT(counts.touching, kPairs / 4);
  EXPECT_GT(counts.apart, kPairs / 10);
}

// A wall may need several pushes: near its end, its side is not the shortest way out.
TEST(ManifoldOf, AnyPairIsFreeOnceItsDeepestPointIsPushedOut) {
  Random random(kSeed + 1);
  int pushed = 0;
  for (int i = 0; i < kPairs; ++i) {
    auto [family, a, b, scale, world] = random_pair(random);
    if (family == "sliver") continue;
    const double tolerance = 16 * kUnitRoundoff * world;
    const int allowed = is_wall(a.shape) || is_wall(b.shape) ? 40 : 1;
    double rest = separation(a.shape, a.pose, b.shape, b.pose).distance;
    pushed += rest < 0.0;
    for (int push = 0; push < allowed && rest < -tolerance; ++push) {
      const Manifold m = manifold(a.shape, a.pose, b.shape, b.pose, 0.0);
      ASSERT_GT(m.count, 0) << family << " " << i << " seed " << kSeed + 1;
      b.pose.position -= least(m) * m.normal;
      rest = separation(a.shape, a.pose, b.shape, b.pose).distance;
    }
    ASSERT_GE(rest, -tolerance) << family << " " << i << " seed " << kSeed + 1;
  }
  EXPECT_GT(pushed, kPairs / 4);
}

TEST(ManifoldOf, AnyPairIsMirroredWhenTheShapesAreSwapped) {
  Random random(kSeed + 2);
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    if (family == "gridded" || family == "shared edge" || family == "sliver")
      continue;  // ties may go either way
    const Manifold m = manifold(a.shape, a.pose, b.shape, b.pose, 0.05 * scale);
    const Manifold swapped = manifold(b.shape, b.pose, a.shape, a.pose, 0.05 * scale);
    ASSERT_EQ(m.count, swapped.count) << family << " " << i;
    if (m.count == 0) continue;
    ASSERT_LE((m.normal + swapped.normal).norm(), 1e-9) << family << " " << i;
    ASSERT_NEAR(least(m), least(swapped), 16 * kUnitRoundoff * world) << family << " " << i;
  }
}

}  // namespace
}  // namespace throng::narrowphase
