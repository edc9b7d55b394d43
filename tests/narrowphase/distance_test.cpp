// SPDX-License-Identifier: MIT
#include "narrowphase/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "narrowphase/exhaustive.h"
#include "plain_shapes.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

void expect_point(const Vec& p, double x, double y) {
  EXPECT_NEAR(p.x(), x, 1e-15);
  EXPECT_NEAR(p.y(), y, 1e-15);
}

TEST(Separation, OfTwoDiscsIsTheGapOfTheirRims) {
  const Separation s = separation(disc(1), at(0, 0), disc(2), at(3, 4));
  EXPECT_DOUBLE_EQ(s.distance, 2.0);
  expect_point(s.normal, 0.6, 0.8);
  expect_point(s.point_a, 0.6, 0.8);
  expect_point(s.point_b, 1.8, 2.4);
}

TEST(Separation, OfDiscsInOnePlaceHasAUnitNormalThatFlipsWithTheirOrder) {
  const Separation s = separation(disc(1), at(5, 5), disc(2), at(5, 5));
  const Separation swapped = separation(disc(2), at(5, 5), disc(1), at(5, 5));
  EXPECT_EQ(s.distance, -3.0);
  EXPECT_EQ(s.normal.norm(), 1.0);
  EXPECT_EQ(s.normal, -swapped.normal);
}

TEST(Separation, OfADiscBeforeAFaceAndACornerAndInside) {
  EXPECT_DOUBLE_EQ(separation(kSquare, at(0, 0), disc(0.5), at(3, 0.3)).distance, 1.5);
  EXPECT_DOUBLE_EQ(separation(kSquare, at(0, 0), disc(1), at(4, 5)).distance, 4.0);
  const Separation inside = separation(disc(0.5), at(0.75, 0.1), kSquare, at(0, 0));
  EXPECT_DOUBLE_EQ(inside.distance, -0.75);
  expect_point(inside.normal, -1, 0);
  expect_point(inside.point_a, 0.25, 0.1);
  expect_point(inside.point_b, 1, 0.1);
}

TEST(Separation, OfTwoSquaresIsTheGapOfTheirFacesOrCorners) {
  const Separation faces = separation(kSquare, at(0, 0), kSquare, at(3, 0.5));
  EXPECT_EQ(faces.distance, 1.0);
  EXPECT_EQ(faces.normal, Vec(1, 0));
  EXPECT_EQ(faces.point_a.x(), 1.0);
  EXPECT_DOUBLE_EQ(separation(kSquare, at(0, 0), kSquare, at(5, 6)).distance, 5.0);
}

TEST(Separation, OfOverlappingSquaresIsMinusTheShortestWayOut) {
  const Separation s = separation(kSquare, at(0, 0), kSquare, at(1.75, 0.5));
  EXPECT_EQ(s.distance, -0.25);
  EXPECT_EQ(s.normal, Vec(1, 0));
  EXPECT_EQ(s.point_a.x(), 1.0);
  EXPECT_EQ(s.point_b.x(), 0.75);
}

TEST(Separation, OfTouchingSquaresIsZeroWithTheFacesNormal) {
  const Separation s = separation(kSquare, at(0, 0), kSquare, at(-2, 0));
  EXPECT_EQ(s.distance, 0.0);
  EXPECT_EQ(s.normal, Vec(-1, 0));
}

TEST(Separation, OfCrossingSegmentsIsTheShortestWayOut) {
  const Separation s = separation(segment({-2, 0}, {2, 0}), at(0, 0), segment({0, -0.25}, {0, 1}), at(0, 0));
  EXPECT_EQ(s.distance, -0.25);
  EXPECT_EQ(s.normal, Vec(0, 1));
}

TEST(Separation, OfCollinearSegmentsIsTheGapOfTheirEnds) {
  EXPECT_DOUBLE_EQ(separation(segment({0, 0}, {1, 0}), at(0, 0), segment({0, 0}, {1, 0}), at(3, 0)).distance,
                   2.0);
  EXPECT_EQ(separation(segment({0, 0}, {1, 0}), at(0, 0), segment({0, 0}, {1, 0}), at(0.5, 0)).distance, 0.0);
  const Convex slanted = segment({0, 0}, {0.3, 0.1});
  EXPECT_NEAR(separation(slanted, at(0, 0), slanted, at(0.9, 0.3)).distance, 2 * std::hypot(0.3, 0.1), 1e-15);
}

TEST(Separation, OfCapsulesTakesTheRadiiOff) {
  const Separation s =
      separation(segment({0, 0}, {1, 0}, 0.25), at(0, 0), segment({0, 0}, {0, 1}, 0.5), at(0.5, 1));
  EXPECT_DOUBLE_EQ(s.distance, 0.25);
  EXPECT_EQ(s.normal, Vec(0, 1));
}

// The edges' lines of two needles that point at each other separate them by less than rounding; their tips
// don't.
TEST(Separation, OfTwoNeedlesTipToTipIsSeen) {
  const double gap = 1e-5;
  for (double width : {1e-6, 1e-10, 1e-12, 1e-14, 1e-15}) {
    const Convex needle = convex({{-1, -width}, {0, 0}, {-1, width}});
    const Pose turned = pose({0.1, 0.2}, 0.7), opposite{turned * Vec{gap, 0}, -turned.cos, -turned.sin};
    const Separation s = separation(needle, turned, needle, opposite);
    EXPECT_NEAR(s.distance, gap, 1e-15) << width;
  }
}

TEST(Separation, OfABodyFarOffTheOriginIsThatAtTheOrigin) {
  const double here = separation(kSquare, at(0, 0), kSquare, at(2.5, 0.25)).distance;
  EXPECT_EQ(separation(kSquare, at(0x1p40, 0), kSquare, at(0x1p40 + 2.5, 0.25)).distance, here);
}

TEST(Separation, HoldsFromAtomsToGalaxies) {
  for (double scale : {1e-150, 1e-30, 1e30, 1e140}) {
    const Separation s =
        separation(scaled(kSquare, scale), at(0, 0), scaled(kSquare, scale), at(5 * scale, 6 * scale));
    EXPECT_NEAR(s.distance / scale, 5.0, 1e-14);
    EXPECT_NEAR(s.normal.norm(), 1.0, 1e-15);
  }
}

// The square of an edge of 1e-200 m is 0, and a length of 0 gave a normal of NaN.
TEST(Separation, OfAnEdgeTooShortToBeSquaredIsANumber) {
  for (double length : {5e-324, 1e-310, 1e-200, 1e-160}) {
    const Convex tiny = segment({0, 0}, {length, 0});
    EXPECT_EQ(tiny.normals[0], Vec(0, -1)) << length;
    EXPECT_EQ(tiny.normals[1], Vec(0, 1)) << length;
    const Separation above = separation(tiny, at(0, 0), disc(1), at(0, 3));
    EXPECT_EQ(above.distance, 2.0) << length;
    EXPECT_EQ(above.normal, Vec(0, 1)) << length;
    const Separation crossed = separation(kSquare, at(0, 0), tiny, at(0.75, 0));
    EXPECT_EQ(crossed.distance, -0.25) << length;
    expect_point(crossed.point_a, 1, 0);
    const Separation crossing = separation(tiny, at(0, 0), segment({0, -1}, {0, 1}), at(0, 0));
    EXPECT_EQ(crossing.distance, 0.0) << length;
    expect_point(crossing.point_a, 0, crossing.point_a.y());
  }
}

TEST(Separation, IsTheExhaustiveOne) {
  Random random(4711);
  constexpr int kPairs = 60000;
  std::map<std::string, int> seen;
  int overlapping = 0;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    const Separation s = separation(a.shape, a.pose, b.shape, b.pose);
    const Separation exact = exhaustive_separation(a.shape, a.pose, b.shape, b.pose);
    ASSERT_NEAR(s.distance, exact.distance, 4 * kUnitRoundoff * scale) << family << " " << i << " seed 4711";
    ASSERT_NEAR(s.normal.squaredNorm(), 1.0, 16 * kUnitRoundoff) << family << " " << i;
    ASSERT_LE((s.point_a + s.distance * s.normal - s.point_b).norm(), 8 * kUnitRoundoff * world)
        << family << " " << i;
    ++seen[family];
    overlapping += s.distance < 0.0;
  }
  EXPECT_EQ(seen.size(), 7u);
  for (const auto& [family, count] : seen) EXPECT_GT(count, kPairs / 20) << family;
  EXPECT_GT(overlapping, kPairs * 3 / 10);
  EXPECT_LT(overlapping, kPairs * 7 / 10);
}

TEST(Separation, IsGoneWhenTheSecondShapeMovesByIt) {
  Random random(4712);
  constexpr int kPairs = 60000;
  for (int i = 0; i < kPairs; ++i) {
    auto [family, a, b, scale, world] = random_pair(random);
    const Separation s = separation(a.shape, a.pose, b.shape, b.pose);
    b.pose.position -= s.distance * s.normal;
    const Separation moved = separation(a.shape, a.pose, b.shape, b.pose);
    ASSERT_NEAR(moved.distance, 0.0, 8 * kUnitRoundoff * world) << family << " " << i << " seed 4712";
  }
}

TEST(Separation, FlipsToTheBitWhenTheShapesAreSwapped) {
  Random random(4713);
  constexpr int kPairs = 60000;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    const Separation s = separation(a.shape, a.pose, b.shape, b.pose);
    const Separation swapped = separation(b.shape, b.pose, a.shape, a.pose);
    if (a.shape.vertices == b.shape.vertices && a.pose.position == b.pose.position)
      continue;  // a segment mirrored
    ASSERT_EQ(s.distance, swapped.distance) << family << " " << i;
    ASSERT_EQ(s.normal, -swapped.normal) << family << " " << i;
    ASSERT_EQ(s.point_a, swapped.point_b) << family << " " << i;
    ASSERT_EQ(s.point_b, swapped.point_a) << family << " " << i;
  }
}

TEST(Separation, ScalesToTheBitWithPowersOfTwo) {
  Random random(4718);
  constexpr int kPairs = 60000;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    const double factor = i % 2 ? 0x1p-20 : 0x1p20;
    const auto larger = [factor](const Placement& p) {
      return Placement{scaled(p.shape, factor), {factor * p.pose.position, p.pose.cos, p.pose.sin}};
    };
    const Placement large_a = larger(a), large_b = larger(b);
    const Separation s = separation(a.shape, a.pose, b.shape, b.pose);
    const Separation t = separation(large_a.shape, large_a.pose, large_b.shape, large_b.pose);
    ASSERT_EQ(t.distance, factor * s.distance) << family << " " << i << " seed 4718";
    ASSERT_EQ(t.normal, s.normal) << family << " " << i << " seed 4718";
    ASSERT_EQ(t.point_a, factor * s.point_a) << family << " " << i << " seed 4718";
  }
}

TEST(Separation, StaysWhenBothShapesMoveRigidly) {
  Random random(4714);
  constexpr int kPairs = 60000;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    const Pose motion = random_pose(random, world);
    const auto moved = [&motion](const Pose& p) {
      return Pose{motion * p.position, motion.cos * p.cos - motion.sin * p.sin,
                  motion.sin * p.cos + motion.cos * p.sin};
    };
    const double before = separation(a.shape, a.pose, b.shape, b.pose).distance;
    const double after = separation(a.shape, moved(a.pose), b.shape, moved(b.pose)).distance;
    ASSERT_NEAR(before, after, 16 * kUnitRoundoff * world) << family << " " << i << " seed 4714";
  }
}

TEST(Separation, OfPolygonsWithTenThousandVerticesIsThatOfTheirDiscs) {
  std::vector<Vec> circle;
  for (int i = 0; i < 10000; ++i) {
    const Pose p = pose({0, 0}, 2 * std::numbers::pi * i / 10000);
    circle.emplace_back(p.cos, p.sin);
  }
  const Convex round = convex(circle);
  const double sagitta = 1 - std::cos(std::numbers::pi / 10000);
  EXPECT_NEAR(separation(round, at(0, 0), round, at(3, 0.1)).distance, std::hypot(3, 0.1) - 2, 2 * sagitta);
  EXPECT_NEAR(separation(round, at(0, 0), round, at(1, 0.1)).distance, std::hypot(1, 0.1) - 2, 2 * sagitta);
}

}  // namespace
}  // namespace throng::narrowphase
