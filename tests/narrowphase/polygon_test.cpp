// SPDX-License-Identifier: MIT
#include "narrowphase/polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "narrowphase/crossing.h"
#include "polygons.h"

namespace throng::narrowphase {
namespace {

using testing::HasSubstr;
using Ring = std::vector<Vec>;

const Ring kCorners = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};

TEST(Clean, LeavesAGoodPolygonAlone) {
  const Cleaned c = clean(kCorners);
  EXPECT_EQ(c.vertices, kCorners);
  EXPECT_TRUE(c.repairs.empty());
  EXPECT_TRUE(c.refusal.empty());
}

TEST(Clean, TakesAClosingVertexAsAMatterOfCourse) {
  const Cleaned c = clean(Ring{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}});
  EXPECT_EQ(c.vertices, kCorners);
  EXPECT_TRUE(c.repairs.empty());
}

TEST(Clean, WeldsRepeatedAndStraightVerticesAndSaysSo) {
  const Cleaned c = clean(Ring{{1, 0}, {2, 0}, {2, 0}, {2, 1}, {2, 1.5}, {2, 2}, {0, 2}, {0, 0}});
  EXPECT_EQ(c.vertices, (Ring{{2, 0}, {2, 2}, {0, 2}, {0, 0}}));
  EXPECT_EQ(c.refusal, "");
  ASSERT_EQ(c.repairs.size(), 4u);
  EXPECT_EQ(c.repairs[0], "vertex 2 repeats the one before it: dropped");
  EXPECT_EQ(c.repairs[1], "vertex 0 lies on a straight edge: dropped");
}

TEST(Clean, TurnsAClockwisePolygonRound) {
  const Cleaned c = clean(Ring{{0, 0}, {0, 2}, {2, 2}, {2, 0}});
  EXPECT_EQ(c.vertices, kCorners);
  EXPECT_EQ(c.repairs.size(), 1u);
}

TEST(Clean, KeepsAVertexThatIsOneUlpOffTheLine) {
  EXPECT_EQ(clean(Ring{{0, 0}, {1, -0x1p-52}, {2, 0}, {1, 1}}).vertices.size(), 4u);
}

TEST(Clean, RefusesABowtieAndNamesItsEdges) {
  const Cleaned c = clean(Ring{{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  EXPECT_THAT(c.refusal, HasSubstr("edge 0-1 meets edge 2-3"));
  EXPECT_TRUE(c.vertices.empty());
}

TEST(Clean, NamesCrossingEdgesByTheGivenVerticesAfterRepairs) {
  const Cleaned c = clean(Ring{{0, 0}, {0, 0}, {1, 1}, {2, 2}, {2, 0}, {0, 2}});
  EXPECT_THAT(c.refusal, HasSubstr("edge 0-3 meets edge 4-5"));
}

TEST(Clean, RefusesAnOutlineThatTouchesItself) {
  EXPECT_NE(clean(Ring{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}).refusal, "");
  EXPECT_NE(clean(Ring{{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}).refusal, "");
}

TEST(Clean, RefusesAFold) {
  EXPECT_NE(clean(Ring{{0, 0}, {4, 0}, {2, 0}, {2, 2}}).refusal, "");
  EXPECT_NE(clean(Ring{{0, 0}, {4, 0}, {4, 4}, {4, 6}, {4, 4}, {0, 4}}).refusal, "");
}

TEST(Clean, RefusesWhatHasNoAreaOrTooFewVertices) {
  EXPECT_THAT(clean(Ring{}).refusal, HasSubstr("three"));
  EXPECT_THAT(clean(Ring{{0, 0}}).refusal, HasSubstr("three"));
  EXPECT_THAT(clean(Ring{{0, 0}, {1, 1}, {0, 0}, {0, 0}}).refusal, HasSubstr("three"));
  EXPECT_THAT(clean(Ring{{0, 0}, {1, 1}, {2, 2}, {3, 3}}).refusal, HasSubstr("no area"));
}

TEST(Clean, RefusesWhatIsNotANumber) {
  for (double x : {std::nan(""), static_cast<double>(INFINITY), 1e308})
    EXPECT_THAT(clean(Ring{{0, 0}, {1, 0}, {1, x}}).refusal, HasSubstr("vertex 2")) << x;
}

// Products of smaller coordinates fall below the doubles, and with them the exact decisions: this sliver's
// turn, half of 1e-340 m², came out as 0, so that a triangle of three corners had no area.
TEST(Clean, RefusesCoordinatesWhoseProductsAreLost) {
  for (double x : {1e-170, -1e-170, 9.9e-141, 5e-324})
    EXPECT_THAT(clean(Ring{{0, 0}, {1, 0}, {1, x}}).refusal, HasSubstr("vertex 2")) << x;
  EXPECT_THAT(clean(Ring{{0, 0}, {1e-170, 0}, {0, 1e-170}}).refusal, HasSubstr("vertex 1 "));
  EXPECT_EQ(clean(Ring{{0, 0}, {1e-140, 0}, {0, 1e-140}}).refusal, "");
  EXPECT_EQ(clean(Ring{{-0.0, 0}, {-1e-140, 1e-140}, {0, -1e-140}}).refusal, "");
}

TEST(FindCrossing, SeesWhatAllPairsOfEdgesSee) {
  Random random(77);
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    Ring points;
    for (std::size_t n = 4 + random() % 6; points.size() < n;) {
      const Vec p(static_cast<double>(random() % 6), static_cast<double>(random() % 6));
      if (points.empty() || (points.back() != p && points.front() != p)) points.push_back(p);
    }
    bool expected = false;
    const std::size_t n = points.size();
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 2; b < n && !(a == 0 && b == n - 1); ++b)
        expected |= segments_meet(points[a], points[a + 1], points[b], points[(b + 1) % n]);
    for (std::size_t a = 0; a < n; ++a) {
      const Vec u = points[(a + 1) % n] - points[a], v = points[(a + 2) % n] - points[(a + 1) % n];
      expected |= u.x() * v.y() == u.y() * v.x() && u.dot(v) < 0;
    }
    ASSERT_EQ(find_crossing(points).has_value(), expected) << "seed 77, " << i;
    crossing += expected;
  }
  EXPECT_GT(crossing, 2000);
  EXPECT_LT(crossing, 19500);
}

TEST(Clean, SaysWhichOfTheVerticesAsGivenAreLeft) {
  const Cleaned c = clean(Ring{{0, 0}, {0, 0}, {0, 2}, {2, 2}, {2, 1}, {2, 0}});
  EXPECT_EQ(c.vertices, kCorners);
  EXPECT_EQ(c.given, (std::vector<std::size_t>{0, 5, 3, 2}));
  EXPECT_EQ(edge_name(c, 3), "edge 0-2");
}

TEST(CleanHole, TurnsAHoleClockwiseWithoutAWord) {
  const Ring clockwise{{0, 0}, {0, 2}, {2, 2}, {2, 0}};
  for (const Cleaned& c : {clean_hole(kCorners), clean_hole(clockwise)}) {
    EXPECT_EQ(c.vertices, clockwise);
    EXPECT_TRUE(c.repairs.empty());
  }
}

TEST(FindCrossing, OfAHundredThousandVerticesTakesNoMinutes) {
  EXPECT_FALSE(find_crossing(star(100000, 0.5)).has_value());
  EXPECT_FALSE(find_crossing(spiral(100000, 100)).has_value());
  EXPECT_FALSE(find_crossing(comb(100000)).has_value());
  Ring knot = star(100000, 0.5);
  std::swap(knot[70001], knot[70003]);
  EXPECT_TRUE(find_crossing(knot).has_value());
}

TEST(MassProperties, OfARectangleAreThoseOfTheTextbook) {
  const Ring rectangle = {{1, 1}, {5, 1}, {5, 3}, {1, 3}};
  const MassProperties m = mass_properties(rectangle);
  EXPECT_EQ(m.area, 8.0);
  EXPECT_EQ(m.centroid, Vec(3, 2));
  EXPECT_NEAR(m.gyration2, (16.0 + 4.0) / 12.0, 1e-15);
}

TEST(MassProperties, OfAnLAreThoseOfItsTwoRectangles) {
  const MassProperties m = mass_properties(Ring{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
  EXPECT_EQ(m.area, 5.0);
  EXPECT_NEAR(m.centroid.x(), (3 * 1.5 + 2 * 0.5) / 5, 1e-15);
  EXPECT_NEAR(m.centroid.y(), (3 * 0.5 + 2 * 2.0) / 5, 1e-15);
  const double inertia = 3 * (10.0 / 12 + Vec(1.5 - 1.1, 0.5 - 1.1).squaredNorm()) +
                         2 * (5.0 / 12 + Vec(0.5 - 1.1, 2.0 - 1.1).squaredNorm());
  EXPECT_NEAR(m.gyration2, inertia / 5, 1e-15);
}

TEST(MassProperties, OfAFrameAreThoseOfItsSquaresTakenFromEachOther) {
  const std::vector<Ring> frame{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{2, 1}, {2, 3}, {3, 3}, {3, 1}}};
  const MassProperties m = mass_properties(frame);
  EXPECT_EQ(m.area, 14.0);
  EXPECT_NEAR(m.centroid.x(), (16 * 2.0 - 2 * 2.5) / 14, 1e-15);
  EXPECT_NEAR(m.centroid.y(), 2.0, 1e-15);
  const double off = 2.0 - m.centroid.x(), hole_off = 2.5 - m.centroid.x();
  const double inertia = 16 * (32.0 / 12 + off * off) - 2 * (5.0 / 12 + hole_off * hole_off);
  EXPECT_DOUBLE_EQ(m.gyration2, inertia / 14);
}

// I_origin - m c² would leave nothing of it.
TEST(MassProperties, FarFromTheOriginKeepTheirDigits) {
  Ring here = star(60, 0.4), there = here;
  for (Vec& v : here) v = Vec(std::round(v.x() * 0x1p20), std::round(v.y() * 0x1p20)) * 0x1p-20;
  there = here;
  for (Vec& v : there) v += Vec(0x1p30, -0x1p29);
  const MassProperties m = mass_properties(here), far = mass_properties(there);
  EXPECT_NEAR(far.area / m.area, 1.0, 1e-14);
  EXPECT_NEAR(far.gyration2 / m.gyration2, 1.0, 1e-7);  // the centroid itself is rounded to 1e-7 there
  EXPECT_NEAR((far.centroid - m.centroid - Vec(0x1p30, -0x1p29)).norm(), 0.0, 0x1p-22);
}

}  // namespace
}  // namespace throng::narrowphase
