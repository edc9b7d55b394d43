// SPDX-License-Identifier: MIT
#include "narrowphase/tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "narrowphase/exhaustive.h"
#include "plain_shapes.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

Convex regular(int count) {
  std::vector<Vec> points;
  for (int i = 0; i < count; ++i) {
    const Pose p = pose({0, 0}, 2 * std::numbers::pi * i / count);
    points.emplace_back(p.cos, p.sin);
  }
  return convex(points);
}

TEST(Track, BeginsFromNothingAndRemembersWhatIsClosest) {
  ClosestFeatures f;
  SearchStatistics statistics;
  const Separation s = track(kSquare, {{0, 0}}, kSquare, {{3, 0.5}}, f, &statistics);
  EXPECT_EQ(s.distance, 1.0);
  EXPECT_EQ(s.normal, Vec(1, 0));
  EXPECT_EQ(s.point_a.x(), 1.0);
  EXPECT_EQ(s.point_b, s.point_a + Vec(1, 0));
  EXPECT_TRUE(f.known);
  EXPECT_EQ(statistics.cold_starts, 1);
}

TEST(Track, LooksAtOnePairOfFeaturesWhereTheyStillHold) {
  ClosestFeatures f;
  track(kSquare, {{0, 0}}, kSquare, {{3, 0.5}}, f);
  const ClosestFeatures before = f;
  SearchStatistics statistics;
  EXPECT_EQ(track(kSquare, {{0, 0}}, kSquare, {{3.25, 0.6}}, f, &statistics).distance, 1.25);
  EXPECT_EQ(f.vertex, before.vertex);
  EXPECT_EQ(f.edge, before.edge);
  EXPECT_EQ(statistics.steps + statistics.cold_starts + statistics.depths + statistics.fallbacks, 0);
}

TEST(Track, WalksRoundACorner) {
  ClosestFeatures f;
  track(kSquare, {{0, 0}}, kSquare, {{3, 0.5}}, f);
  SearchStatistics statistics;
  EXPECT_EQ(track(kSquare, {{0, 0}}, kSquare, {{5, 6}}, f, &statistics).distance, 5.0);
  EXPECT_EQ(track(kSquare, {{0, 0}}, kSquare, {{0.5, 4}}, f, &statistics).distance, 2.0);
  EXPECT_GT(statistics.steps, 0);
  EXPECT_EQ(statistics.cold_starts + statistics.fallbacks, 0);
}

TEST(Track, GoesFromApartToTouchingToDeepAndBack) {
  ClosestFeatures f;
  for (double x : {3.0, 2.0, 1.75, 0.5, 1.75, 2.0, 3.0})
    EXPECT_EQ(track(kSquare, {{0, 0}}, kSquare, {{x, 0.25}}, f).distance, x - 2.0) << x;
}

// Two faces that touch leave no gap whose sign rounding couldn't turn: the features must hold all the same.
TEST(Track, KeepsToTouchingFaces) {
  const Pose turned = pose({0.1, 0.2}, 0.7), on_top{turned * Vec{0.5, 2.0}, turned.cos, turned.sin};
  ClosestFeatures f;
  track(kSquare, turned, kSquare, on_top, f);
  SearchStatistics statistics;
  EXPECT_NEAR(track(kSquare, turned, kSquare, on_top, f, &statistics).distance, 0.0, 4e-16);
  EXPECT_EQ(statistics.steps + statistics.cold_starts + statistics.depths, 0);
}

TEST(Track, FollowsADiscRoundAPolygon) {
  const Convex ball = disc(0.25);
  ClosestFeatures f;
  SearchStatistics statistics;
  for (int i = 0; i < 1000; ++i) {
    const Pose round = pose({0, 0}, 0.01 * i), place{Vec{3 * round.cos, 3 * round.sin}};
    const double exact = exhaustive_separation(kSquare, {}, ball, place).distance;
    ASSERT_NEAR(track(kSquare, {}, ball, place, f, &statistics).distance, exact, 8 * kUnitRoundoff) << i;
  }
  EXPECT_EQ(statistics.cold_starts, 1);
  EXPECT_LT(statistics.steps, 20);
  EXPECT_EQ(statistics.fallbacks, 0);
}

TEST(Track, AnswersForTwoDiscs) {
  ClosestFeatures f;
  EXPECT_DOUBLE_EQ(track(disc(1), {{0, 0}}, disc(2), {{3, 4}}, f).distance, 2.0);
}

// A vertex on the line between its neighbours: both of its edges have one normal, and the far side of the
// polygon passes for the near one unless somebody looks. Textbook trackers stop there.
TEST(Track, IsNotFooledByVerticesInTheMiddleOfAnEdge) {
  const Convex split = convex({{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}});
  for (std::uint32_t vertex = 0; vertex < 8; ++vertex)
    for (std::uint32_t edge = 0; edge < 8; ++edge)
      for (const Vec& at : {Vec{3, 0}, Vec{0.5, 0.25}, Vec{0, -2.5}, Vec{-4, 5}, Vec{1, 0}}) {
        ClosestFeatures f{vertex, edge, edge % 2 == 0, true};
        const double exact = exhaustive_separation(split, {}, split, {at}).distance;
        EXPECT_NEAR(track(split, {}, split, {at}, f).distance, exact, 1e-15) << vertex << " " << edge;
      }
}

/// Random pairs, each asked from features that know nothing of it.
TEST(Track, AnswersRightFromAnyFeatures) {
  Random random(1991);
  constexpr int kPairs = 20000;
  std::map<std::string, int> seen;
  SearchStatistics statistics;
  int overlapping = 0;
  for (int i = 0; i < 3 * kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    ClosestFeatures f{static_cast<std::uint32_t>(random() % 9), static_cast<std::uint32_t>(random() % 9),
                      random() % 2 == 0, true};
    const Separation s = track(a.shape, a.pose, b.shape, b.pose, f, &statistics);
    const double exact = exhaustive_separation(a.shape, a.pose, b.shape, b.pose).distance;
    ASSERT_NEAR(s.distance, exact, 4 * kUnitRoundoff * scale) << family << " " << i << " seed 1991";
    ASSERT_NEAR(s.normal.squaredNorm(), 1.0, 16 * kUnitRoundoff) << family << " " << i;
    ASSERT_LE((s.point_a + s.distance * s.normal - s.point_b).norm(), 8 * kUnitRoundoff * world)
        << family << " " << i;
    ++seen[family];
    overlapping += exact < 0.0;
  }
  EXPECT_EQ(seen.size(), 7u);
  EXPECT_GT(overlapping, kPairs);
  EXPECT_GT(statistics.steps, kPairs / 4);
  EXPECT_LT(statistics.fallbacks, kPairs / 20);
}

/// The same pairs in motion, so that features go through contact, overlap and out again.
TEST(Track, AnswersRightThroughAnyMotion) {
  Random random(1992);
  constexpr int kPairs = 20000;
  SearchStatistics statistics;
  int crossed = 0;
  for (int i = 0; i < kPairs / 20; ++i) {
    auto [family, a, b, scale, world] = random_pair(random);
    const Vec towards = 0.05 * (a.pose.position - b.pose.position);
    const double turn = uniform(random, -0.3, 0.3);
    const Pose first = b.pose;
    ClosestFeatures f;
    bool apart = false, inside = false;
    for (int step = 0; step < 40; ++step) {
      const double found = track(a.shape, a.pose, b.shape, b.pose, f, &statistics).distance;
      const double exact = exhaustive_separation(a.shape, a.pose, b.shape, b.pose).distance;
      ASSERT_NEAR(found, exact, 8 * kUnitRoundoff * scale) << family << " " << i << " step " << step;
      apart |= exact > 0.0, inside |= exact < 0.0;
      b.pose.position += towards;
      const Pose by = pose({0, 0}, turn * step);
      b.pose.cos = by.cos * first.cos - by.sin * first.sin,
      b.pose.sin = by.sin * first.cos + by.cos * first.sin;
    }
    crossed += apart && inside;
  }
  EXPECT_GT(crossed, kPairs / 50);
}

TEST(Track, MirrorsToTheBitWhenTheShapesAreSwappedWithTheirFeatures) {
  Random random(1993);
  constexpr int kPairs = 20000;
  int held = 0;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    ClosestFeatures f;
    track(a.shape, a.pose, b.shape, b.pose, f);
    ClosestFeatures mirrored = f;
    mirrored.vertex_of_b = !f.vertex_of_b;
    SearchStatistics s;
    const Separation straight = track(a.shape, a.pose, b.shape, b.pose, f, &s);
    const Separation swapped = track(b.shape, b.pose, a.shape, a.pose, mirrored);
    ASSERT_NEAR(straight.distance, swapped.distance, 4 * kUnitRoundoff * scale) << family << " " << i;
    if (s.steps + s.cold_starts > 0) continue;  // deep
    ASSERT_EQ(straight.distance, swapped.distance) << family << " " << i;
    ASSERT_EQ(straight.normal, -swapped.normal) << family << " " << i;
    ASSERT_EQ(straight.point_a, swapped.point_b) << family << " " << i;
    ++held;
  }
  EXPECT_GT(held, kPairs / 4);
}

// The square of such a gap is 0.
TEST(Track, SeesAGapBetweenCornersThatIsTooSmallToBeSquared) {
  const Convex left = convex({{0, 0}, {-1, 0}, {0, -1}}), right = convex({{0, 0}, {1, 0}, {0, 1}});
  for (double gap : {1e-100, 1e-170, 1e-300}) {
    ClosestFeatures f{0, 0, true, true};
    for (int again = 0; again < 2; ++again) {
      const Separation s = track(left, {{0, 0}}, right, {{gap, gap}}, f);
      EXPECT_NEAR(s.distance / gap, std::sqrt(2.0), 1e-15) << gap;
      EXPECT_NEAR(s.normal.x(), std::sqrt(0.5), 1e-15) << gap;
    }
  }
}

TEST(Track, PutsItsWitnessesOnTheSurfaces) {
  Random random(1994);
  constexpr int kPairs = 20000;
  int apart = 0;
  for (int i = 0; i < kPairs; ++i) {
    const auto [family, a, b, scale, world] = random_pair(random);
    ClosestFeatures f;
    const Separation s = track(a.shape, a.pose, b.shape, b.pose, f);
    if (s.distance <= 0.0) continue;
    const Convex point = disc(0.0);
    ASSERT_NEAR(exhaustive_separation(a.shape, a.pose, point, {s.point_a}).distance, 0.0,
                16 * kUnitRoundoff * world)
        << family << " " << i;
    ASSERT_NEAR(exhaustive_separation(b.shape, b.pose, point, {s.point_b}).distance, 0.0,
                16 * kUnitRoundoff * world)
        << family << " " << i;
    ++apart;
  }
  EXPECT_GT(apart, kPairs / 4);
}

TEST(Track, TakesOneOrTwoStatesAQueryWhereMotionIsSmall) {
  for (int count : {4, 8, 40, 400}) {
    const Convex shape = regular(count);
    ClosestFeatures f;
    SearchStatistics statistics;
    const int steps = 2000;
    for (int i = 0; i < steps; ++i)
      track(shape, pose({0, 0}, 0.01 * i), shape, pose({2.2, 0.3}, -0.007 * i), f, &statistics);
    EXPECT_LT(statistics.steps, count <= 40 ? steps / 4 : 2 * steps) << count;
    EXPECT_EQ(statistics.cold_starts, 1) << count;
    EXPECT_EQ(statistics.fallbacks, 0) << count;
  }
}

TEST(Track, ReachesTheFarSideOfManyVerticesByASearch) {
  const Convex shape = regular(4000);
  ClosestFeatures f;
  SearchStatistics statistics;
  track(shape, {{0, 0}}, shape, {{2.2, 0.3}}, f);
  const Separation s = track(shape, {{0, 0}}, shape, {{-2.2, -0.3}}, f, &statistics);
  EXPECT_NEAR(s.distance, std::hypot(2.2, 0.3) - 2, 1e-6);
  EXPECT_EQ(statistics.cold_starts, 1);
  EXPECT_EQ(statistics.fallbacks, 0);
  EXPECT_LT(statistics.steps, 40);
}

// A walk over so many edges costs more than a search, and is in vain where it gives up.
TEST(Track, SearchesAtOnceWhatIsManyEdgesAway) {
  const Convex shape = regular(4000);
  ClosestFeatures start;
  track(shape, {{0, 0}}, shape, {{2.2, 0}}, start);
  const Pose turned = pose({0, 0}, 0.1), turned_along = pose({2.2, 0}, -0.1), slid{{2.2, 0.2}};
  const std::pair<Pose, Pose> moves[] = {{turned, {{2.2, 0}}}, {turned, turned_along}, {{{0, 0}}, slid}};
  for (const auto& [a, b] : moves) {
    ClosestFeatures f = start;
    SearchStatistics statistics;
    EXPECT_NEAR(track(shape, a, shape, b, f, &statistics).distance, b.position.norm() - 2, 1e-6);
    EXPECT_EQ(statistics.cold_starts, 1);
    EXPECT_LT(statistics.steps, 8);
  }
}

// A walk that takes too long is no overlap: nobody scans thousands of faces for a depth.
TEST(Track, TakesALongWayForNoOverlap) {
  const Convex shape = regular(4000);
  ClosestFeatures f;
  SearchStatistics statistics;
  for (int i = 0; i < 40; ++i)
    track(shape, pose({0, 0}, 0.1 * i), shape, pose({2.2, 0.3}, -0.07 * i), f, &statistics);
  EXPECT_GT(statistics.cold_starts, 10);
  EXPECT_EQ(statistics.depths, 0);
  EXPECT_EQ(statistics.fallbacks, 0);
}

}  // namespace
}  // namespace throng::narrowphase
