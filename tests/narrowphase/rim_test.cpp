// SPDX-License-Identifier: MIT
#include "narrowphase/rim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "narrowphase/decompose.h"
#include "narrowphase/weld.h"

namespace throng::narrowphase {
namespace {

/// Two pieces of wall that meet at the origin, the second one rising by that angle.
std::vector<Convex> bent_wall(double angle) {
  return {segment({-1, 0}, {0, 0}), segment({0, 0}, {std::cos(angle), std::sin(angle)})};
}

/// The edge of a segment whose normal looks up.
const RimEdge& upper(const Convex& part, const Rim& rim) {
  return rim[part.normals[0].y() > 0.0 ? 0 : 1];
}

TEST(Weld, NumbersPointsThatAreOneButForRounding) {
  const std::vector<Vec> points = {{0.3, 1}, {0.1 + 0.2, 1}, {0.3 + 1e-12, 1}, {0.3, 1}, {0, 0}};
  EXPECT_EQ(weld(points), (std::vector<std::uint32_t>{0, 0, 1, 0, 2}));
  EXPECT_EQ(weld(std::vector<Vec>{{0, 0}, {-0.0, 0}}), (std::vector<std::uint32_t>{0, 0}));
}

TEST(Rims, AreEmptyForPartsThatMeetNoOther) {
  const std::vector<Convex> parts = {convex({{0, 0}, {1, 0}, {1, 1}}), segment({3, 0}, {4, 0}),
                                     disc(1, {9, 9})};
  for (const Rim& rim : rims(parts)) EXPECT_TRUE(rim.empty());
}

TEST(Rims, KnowHowAWallTurnsOnEachSide) {
  for (const double angle : {0.0, 0.5, -0.5}) {
    const std::vector<Convex> parts = bent_wall(angle);
    const std::vector<Rim> r = rims(parts);
    ASSERT_EQ(r[0].size(), 2u);
    const RimEdge& top = upper(parts[0], r[0]);
    const RimEdge& under = &top == &r[0][0] ? r[0][1] : r[0][0];
    const Turn expected = angle == 0.0 ? Turn::flat : angle > 0.0 ? Turn::concave : Turn::convex;
    // The upper side runs from right to left: the solid is on its left, below.
    EXPECT_EQ(top.at_tail, expected) << angle;
    EXPECT_EQ(top.at_head, Turn::convex) << "the free end";
    EXPECT_EQ(under.at_head, angle == 0.0 ? Turn::flat : angle > 0.0 ? Turn::convex : Turn::concave);
  }
}

TEST(Rims, TellPiecesThatBendGently) {
  for (const auto& [angle, gently] : {std::pair{0.0, false}, {0.005, true}, {-0.005, true}, {0.02, false}}) {
    const std::vector<Convex> parts = bent_wall(angle);
    const std::vector<Rim> r = rims(parts);
    for (int i = 0; i < 2; ++i) EXPECT_EQ(bends_gently(parts[i], r[i]), gently) << angle;
  }
  EXPECT_FALSE(bends_gently(segment({0, 0}, {1, 0}), {})) << "it meets no other";
}

TEST(Rims, TakeTheNearestOfSeveralWallsRoundAPoint) {
  const std::vector<Convex> parts = {segment({-1, 0}, {0, 0}), segment({0, 0}, {1, 0}),
                                     segment({0, 0}, {0, 1})};
  const std::vector<Rim> r = rims(parts);
  const RimEdge& top = upper(parts[0], r[0]);
  EXPECT_EQ(top.at_tail, Turn::concave);
  EXPECT_EQ(top.before, Vec(-1, 0)) << "the left side of the wall that stands there";
}

TEST(Rims, FindTheSeamsOfADecomposedPolygon) {
  const std::vector<Vec> ell = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const std::vector<Convex> parts = decompose(ell);
  ASSERT_EQ(parts.size(), 2u);
  const std::vector<Rim> r = rims(parts);
  int seams = 0, hollows = 0;
  for (std::size_t p = 0; p < 2; ++p)
    for (const RimEdge& edge : r[p]) {
      seams += edge.inner;
      hollows += !edge.inner && edge.at_head == Turn::concave;
    }
  EXPECT_EQ(seams, 2);
  EXPECT_EQ(hollows, 1) << "the reflex corner, once as a head";
}

/// Of the second wall and a body, made for this: the normal points from the wall to the body.
Manifold against_second(const std::vector<Convex>& parts, const Convex& body, const Pose& at, double reach) {
  const Manifold bare = manifold(parts[1], {}, body, at, reach);
  const Rim rim = rims(parts)[1];
  return rim.empty() ? bare : on_outline(bare, {parts[1], Pose{}}, rim, {body, at}, reach, false);
}

TEST(OnOutline, LeavesABodyOverTheFirstPieceToIt) {
  const Convex ball = disc(0.5), box = convex({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});
  for (const double angle : {0.0, -0.5}) {
    const std::vector<Convex> parts = bent_wall(angle);
    EXPECT_GT(manifold(parts[1], {}, ball, {{-0.1, 0.5}}, 0.2).count, 0);
    EXPECT_EQ(against_second(parts, ball, {{-0.1, 0.5}}, 0.2).count, 0);
    EXPECT_GT(manifold(parts[1], {}, box, {{-0.6, 0.5}}, 0.2).count, 0);
    EXPECT_EQ(against_second(parts, box, {{-0.6, 0.5}}, 0.2).count, 0);
  }
}

/// However little it leans: both pieces hold it all of the time, by the same names.
TEST(OnOutline, LeavesABoxThatRocksOverASeamToBothPieces) {
  const Convex box = convex({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});
  for (const double bend : {0.0, 1e-9, 1e-5, -1e-5}) {
    const std::vector<Convex> parts = bent_wall(bend);
    std::array<std::uint32_t, 2> names{};
    for (const double lean : {1e-9, -1e-4, 1e-4, -1e-3, 1e-3}) {
      const Manifold m = against_second(parts, box, pose({0.1, 0.4999}, lean), 0.1);
      ASSERT_EQ(m.count, 2) << bend << " " << lean;
      EXPECT_NEAR(m.normal.x(), 0.0, 2e-5);
      for (const ManifoldPoint& point : m.points) {
        EXPECT_GT(point.point.x(), -1e-3);
        EXPECT_NEAR(point.separation, -1e-4 + (point.point.x() - 0.1) * lean, 2e-6 + std::abs(bend));
      }
      std::array<std::uint32_t, 2> now{without_reference(m.points[0].feature),
                                       without_reference(m.points[1].feature)};
      std::ranges::sort(now);
      if (lean == 1e-9) names = now;
      EXPECT_EQ(now, names) << bend << " " << lean;
    }
  }
}

TEST(OnOutline, PressesOnTheFaceBeyondAHollow) {
  const Convex box = convex({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});
  const std::vector<Convex> parts = bent_wall(0.5);
  const Manifold m = against_second(parts, box, {{-0.6, 0.5}}, 0.2);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.normal.x(), -std::sin(0.5), 1e-15);
  EXPECT_NEAR(m.normal.y(), std::cos(0.5), 1e-15);
  EXPECT_NEAR(m.points[0].separation, 0.1 * std::sin(0.5), 1e-15);
}

/// However it leans: who is in a solid up to his middle is still held, also where the face ends in a hollow.
TEST(OnOutline, HoldsWhoHasSunkBehindAFaceThatEndsInAHollow) {
  const std::vector<Convex> parts = {convex({{-2, -1}, {0.1, -1}, {0, 0}, {-2, 0}}),
                                     convex({{0.1, -1}, {1, -1}, {1, 2}, {0, 2}, {0, 0}})};
  const Rim rim = rims(parts)[0];
  const Convex bar = convex({{-0.3, -0.01}, {0.3, -0.01}, {0.3, 0.01}, {-0.3, 0.01}});
  for (const double depth : {0.005, 0.012, 0.019})
    for (const double lean : {-1e-2, -1e-3, 0.0, 1e-3, 1e-2}) {
      const Pose at = pose({-0.25, 0.01 - depth}, lean);
      const Manifold m =
          on_outline(manifold(parts[0], {}, bar, at, 0.1), {parts[0], {}}, rim, {bar, at}, 0.1, false);
      ASSERT_GT(m.count, 0) << depth << " m, " << lean;
      EXPECT_GT(m.normal.y(), 0.999);
      EXPECT_NEAR(m.points[0].separation, -depth, 0.3 * std::abs(lean) + 1e-9);
    }
}

TEST(OnOutline, KeepsWhatLeansNoFurtherThanTheCorner) {
  const Convex ball = disc(0.5);
  const std::vector<Convex> parts = bent_wall(-1.0);
  const Pose over_corner{{0.2, 0.5}};
  const Manifold bare = manifold(parts[1], {}, ball, over_corner, 0.2),
                 m = against_second(parts, ball, over_corner, 0.2);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.normal, bare.normal);
}

TEST(OnOutline, KeepsAWallsFreeEndAndBothItsSides) {
  const Convex ball = disc(0.5);
  const std::vector<Convex> parts = bent_wall(0.0);
  for (const Vec& at : {Vec{1.4, 0.1}, Vec{0.5, 0.5}, Vec{0.5, -0.5}, Vec{1.3, -0.3}})
    EXPECT_EQ(against_second(parts, ball, {at}, 0.1).count, 1) << at.transpose();
}

/// A box that reaches into the second tile by less than it has sunk would be pushed back through the seam.
TEST(OnOutline, TurnsWhatASeamWouldPushToTheFaceBesideIt) {
  const Convex box = convex({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});
  const std::vector<Convex> tiles = {convex({{-2, -1}, {0, -1}, {0, 0}, {-2, 0}}),
                                     convex({{0, -1}, {2, -1}, {2, 0}, {0, 0}})};
  const Pose at{{-0.45, 0.44}};
  EXPECT_EQ(manifold(tiles[1], {}, box, at, 0.1).normal, Vec(-1, 0));
  const Manifold m = against_second(tiles, box, at, 0.1);
  ASSERT_EQ(m.count, 2);
  EXPECT_EQ(m.normal, Vec(0, 1));
  EXPECT_NEAR(m.points[0].separation, -0.06, 1e-15);
}

TEST(OnOutline, HoldsACornerOnASeamByThePartBelowIt) {
  const Convex box = convex({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});
  const std::vector<Convex> tiles = {convex({{-2, -1}, {0, -1}, {0, 0}, {-2, 0}}),
                                     convex({{0, -1}, {2, -1}, {2, 0}, {0, 0}})};
  for (const double x : {0.0, 1e-9, 0.01}) {
    const Pose at = pose({x, std::sqrt(0.5) - 0.1}, std::numbers::pi / 4);
    const Manifold m = against_second(tiles, box, at, 0.01);
    ASSERT_EQ(m.count, 1) << x;
    EXPECT_EQ(m.normal, Vec(0, 1)) << x;
    EXPECT_NEAR(m.points[0].separation, -0.1, 1e-9) << x;
  }
}

TEST(OnOutline, LeavesWallsThatStandTwiceAsTheyAre) {
  const std::vector<Convex> walls = {segment({0, 0}, {4, 0}), segment({0, 0}, {4, 0}),
                                     segment({4, 0}, {0, 0})};
  for (const double y : {0.4, -0.4}) {
    const Pose at{{2, y}};
    EXPECT_EQ(against_second(walls, disc(0.5), at, 0.1).count, 1);
  }
}

}  // namespace
}  // namespace throng::narrowphase
