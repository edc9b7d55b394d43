// SPDX-License-Identifier: MIT
#include "narrowphase/manifold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "narrowphase/distance.h"
#include "narrowphase/wall.h"
#include "plain_shapes.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

const Convex kWall = segment({-10, 0}, {10, 0});

std::set<std::uint32_t> features(const Manifold& m) {
  std::set<std::uint32_t> names;
  for (int i = 0; i < m.count; ++i)
    names.insert(without_reference(m.points[static_cast<std::size_t>(i)].feature));
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

/// The reference that all points of a manifold tell.
Reference reference_of(const Manifold& m, const Convex& a, const Convex& b) {
  const Reference first = reference(m.points[0].feature, a, b);
  for (int i = 1; i < m.count; ++i) {
    const Reference other = reference(m.points[static_cast<std::size_t>(i)].feature, a, b);
    EXPECT_EQ(other.edge, first.edge);
    EXPECT_EQ(other.of_b, first.of_b);
  }
  return first;
}

// A square that rocks and slides a little on another; its face is now the widest, now the other's.
TEST(ManifoldOf, ARockingSquareKeepsItsReference) {
  const double angles[] = {0.0, 3e-6, -3e-6, 1e-9, -1e-9, 1e-16, -1e-16, 1e-6, -1e-6};
  for (double begin : {3e-6, -3e-6}) {
    Reference kept =
        reference_of(manifold(kSquare, at(0, 0), kSquare, pose({0.25, 1.99}, begin), 0.05), kSquare, kSquare);
    const Reference first = kept;
    ASSERT_TRUE(first.known);
    int otherwise = 0;
    for (double angle : angles)
      for (double slide : {0.25, 0.2500001, -0.1, 0.0}) {
        const Pose rocked = pose({slide, 1.99}, angle);
        const Manifold m = manifold(kSquare, at(0, 0), kSquare, rocked, 0.05, kept);
        ASSERT_EQ(m.count, 2);
        kept = reference_of(m, kSquare, kSquare);
        EXPECT_EQ(kept.of_b, first.of_b) << begin << " " << angle << " " << slide;
        EXPECT_EQ(kept.edge, first.edge) << begin << " " << angle << " " << slide;
        const Vec normal = first.of_b ? Vec(-rocked.rotate(kSquare.normals[kept.edge])) : Vec(0, 1);
        EXPECT_NEAR((m.normal - normal).norm(), 0.0, 1e-15);
        const Manifold afresh = manifold(kSquare, at(0, 0), kSquare, rocked, 0.05);
        otherwise += reference_of(afresh, kSquare, kSquare).of_b != first.of_b;
      }
    EXPECT_GT(otherwise, 4) << "nothing to hold against";
  }
}

// A corner as deep behind two faces of one square: rounding must not turn the normal by a right angle.
TEST(ManifoldOf, ACornerBetweenTwoFacesKeepsTheOneThatItTouches) {
  for (std::uint32_t edge : {1u, 2u})
    for (double by : {3e-6, 1e-16, 0.0, -1e-16, -3e-6}) {
      const Manifold m =
          manifold(kSquare, at(0, 0), kSquare, at(1.9 + by, 1.9 - by), 0.0, {edge, false, true});
      EXPECT_EQ(reference_of(m, kSquare, kSquare).edge, edge) << by;
      EXPECT_EQ(m.normal, kSquare.normals[edge]) << by;
    }
}

TEST(ManifoldOf, AFaceThatIsClearlyWiderTakesOver) {
  const Reference right{1, false, true};
  EXPECT_EQ(manifold(kSquare, at(0, 0), kSquare, at(1.9, 1.9000076), 0.0, right).normal, Vec(1, 0));
  EXPECT_EQ(manifold(kSquare, at(0, 0), kSquare, at(1.9, 1.9000077), 0.0, right).normal, Vec(0, 1));
}

TEST(ManifoldOf, AnyPairWithAnyKeptReferenceIsRightWithinTheHold) {
  Random random(90213);
  constexpr int kPairs = 60000;
  int changed = 0, touching = 0;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    const Reference kept{static_cast<std::uint32_t>(random() % 9), random() % 2 == 0, true};
    if (family == "sliver") continue;
    const Manifold afresh = manifold(a.shape, a.pose, b.shape, b.pose, 0.0);
    const Manifold m = manifold(a.shape, a.pose, b.shape, b.pose, 0.0, kept);
    if ((m.count > 0) != (afresh.count > 0)) {
      ASSERT_NEAR(least(m.count > 0 ? m : afresh), 0.0, 16 * kUnitRoundoff * world) << family << " " << i;
      continue;
    }
    if (m.count == 0) continue;
    ++touching;
    changed += m.normal != afresh.normal;
    ASSERT_NEAR(m.normal.norm(), 1.0, 8 * kUnitRoundoff);
    // No face is longer than 3/8 of the coordinates' scale.
    ASSERT_NEAR(least(m), least(afresh), 0x1p-18 * 3 * scale / 8 + 16 * kUnitRoundoff * world)
        << family << " " << i << " seed 90213";
  }
  EXPECT_GT(touching, kPairs / 4);
  EXPECT_GT(changed, 30);
}

TEST(ManifoldOf, AnyPairTellsTheFaceItIsDescribedOn) {
  Random random(90214);
  constexpr int kPairs = 60000;
  int of_a = 0, of_b = 0;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    const Manifold m = manifold(a.shape, a.pose, b.shape, b.pose, 0.0);
    if (m.count == 0) continue;
    const bool disc = a.shape.normals.empty() || b.shape.normals.empty();
    const Reference told = reference_of(m, a.shape, b.shape);
    ASSERT_EQ(told.known, !disc) << family << " " << i;
    if (disc || separation(a.shape, a.pose, b.shape, b.pose).distance > -a.shape.radius - b.shape.radius)
      continue;  // cores apart: the normal may be that of two corners
    const Vec normal = told.of_b ? Vec(-b.pose.rotate(b.shape.normals[told.edge]))
                                 : a.pose.rotate(a.shape.normals[told.edge]);
    ASSERT_EQ(m.normal, normal) << family << " " << i << " seed 90214";
    ++(told.of_b ? of_b : of_a);
  }
  EXPECT_GT(of_a, kPairs / 20);
  EXPECT_GT(of_b, kPairs / 20);
}

TEST(ManifoldOf, AnyPairIsMirroredWhenTheShapesAreSwappedWithTheirReference) {
  Random random(90215);
  constexpr int kPairs = 60000;
  int held = 0;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    const Manifold first = manifold(a.shape, a.pose, b.shape, b.pose, 0.0);
    if (first.count == 0) continue;
    Reference kept = reference_of(first, a.shape, b.shape);
    const Manifold m = manifold(a.shape, a.pose, b.shape, b.pose, 0.0, kept);
    const Reference stays = reference_of(m, a.shape, b.shape);
    ASSERT_EQ(stays.edge, kept.edge) << family << " " << i;
    ASSERT_EQ(stays.of_b, kept.of_b) << family << " " << i;
    kept.of_b = !kept.of_b;
    const Manifold swapped = manifold(b.shape, b.pose, a.shape, a.pose, 0.0, kept);
    if (is_wall(a.shape) || is_wall(b.shape) || family == "sliver") continue;  // nothing is kept, ties
    if (!kept.known) continue;
    ASSERT_EQ(reference_of(swapped, b.shape, a.shape).edge, kept.edge) << family << " " << i;
    ASSERT_LE((m.normal + swapped.normal).norm(), 1e-9) << family << " " << i;
    ASSERT_NEAR(least(m), least(swapped), 16 * kUnitRoundoff * world) << family << " " << i;
    ++held;
  }
  EXPECT_GT(held, kPairs / 10);
}

struct Counts {
  int touching = 0, apart = 0;
};

/// The manifold against the exact separation: there exactly where the shapes are within reach, its normal a
/// separating direction, no point deeper than the shapes.
TEST(ManifoldOf, AnyPairAgreesWithTheExactSeparation) {
  Random random(90210);
  constexpr int kPairs = 60000;
  Counts counts;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    if (is_wall(a.shape) || is_wall(b.shape) || family == "sliver") continue;
    const double reach = 0.05 * scale, tolerance = 16 * kUnitRoundoff * world;
    const Separation s = separation(a.shape, a.pose, b.shape, b.pose);
    const Manifold m = manifold(a.shape, a.pose, b.shape, b.pose, reach);
    if (std::abs(s.distance - reach) <= tolerance) continue;
    ASSERT_EQ(m.count > 0, s.distance < reach) << family << " " << i << " seed 90210";
    ++(m.count > 0 ? counts.touching : counts.apart);
    if (m.count == 0) continue;
    ASSERT_NEAR(m.normal.norm(), 1.0, 8 * kUnitRoundoff);
    ASSERT_LE(least(m), reach);
    if (s.distance > tolerance)
      ASSERT_LE(std::abs(least(m) - s.distance), 0.02 * scale) << family << " " << i << " seed 90210";
    else
      ASSERT_NEAR(least(m), s.distance, tolerance) << family << " " << i << " seed 90210";
  }
  EXPECT_GT(counts.touching, kPairs / 4);
  EXPECT_GT(counts.apart, kPairs / 10);
}

// A wall may need several pushes: near its end, its side is not the shortest way out.
TEST(ManifoldOf, AnyPairIsFreeOnceItsDeepestPointIsPushedOut) {
  Random random(90211);
  constexpr int kPairs = 60000;
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
      ASSERT_GT(m.count, 0) << family << " " << i << " seed 90211";
      b.pose.position -= least(m) * m.normal;
      rest = separation(a.shape, a.pose, b.shape, b.pose).distance;
    }
    ASSERT_GE(rest, -tolerance) << family << " " << i << " seed 90211";
  }
  EXPECT_GT(pushed, kPairs / 4);
}

TEST(ManifoldOf, AnyPairIsMirroredWhenTheShapesAreSwapped) {
  Random random(90212);
  constexpr int kPairs = 60000;
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
