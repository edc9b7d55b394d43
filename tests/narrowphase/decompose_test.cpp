// SPDX-License-Identifier: MIT
#include "narrowphase/decompose.h"

#include <gtest/gtest.h>

#include "narrowphase/distance.h"
#include "narrowphase/orientation.h"
#include "narrowphase/polygon.h"
#include "polygons.h"

namespace throng::narrowphase {
namespace {

using Ring = std::vector<Vec>;

using Rings = std::vector<Ring>;

/// What every decomposition must be: convex parts, no overlap, all of the area.
void expect_parts(const Rings& rings, const std::vector<Convex>& parts) {
  double area = 0.0;
  for (const Convex& part : parts) {
    const std::size_t n = part.vertices.size();
    ASSERT_GE(n, 3u);
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_EQ(orientation(part.vertices[i], part.vertices[(i + 1) % n], part.vertices[(i + 2) % n]), 1);
    area += mass_properties(part.vertices).area;
  }
  const double whole = mass_properties(rings).area;
  EXPECT_NEAR(area / whole, 1.0, 1e-12);
}

void expect_parts(const Ring& polygon, const std::vector<Convex>& parts) {
  expect_parts(Rings{polygon}, parts);
}

void expect_no_overlap(const std::vector<Convex>& parts, double tolerance) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_GE(separation(parts[i], {}, parts[j], {}).distance, -tolerance);
}

/// By the even-odd rule, of a point on no edge.
bool is_inside(const Rings& rings, const Vec& x) {
  bool inside = false;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec &p = ring[i], &q = ring[(i + 1) % ring.size()];
      const bool passes =
          (p.y() > x.y()) != (q.y() > x.y()) && orientation(p, q, x) == (q.y() > p.y() ? 1 : -1);
      inside ^= passes;
    }
  return inside;
}

std::size_t reflex_vertices(const Ring& polygon) {
  std::size_t count = 0;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i)
    count += orientation(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]) < 0;
  return count;
}

TEST(Decompose, LeavesAConvexPolygonWhole) {
  const auto parts = decompose(star(12, 1.0), 0.25);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].vertices.size(), 12u);
  EXPECT_EQ(parts[0].radius, 0.25);
  EXPECT_EQ(parts[0].normals.size(), 12u);
}

TEST(Decompose, CutsAnLOnce) {
  const Ring polygon{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  const auto parts = decompose(polygon);
  EXPECT_EQ(parts.size(), 2u);
  expect_parts(polygon, parts);
}

TEST(Decompose, CopesWithVerticesThatEveryDiagonalRunsAlong) {
  const Ring cross{{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                   {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  expect_parts(cross, decompose(cross));
  expect_no_overlap(decompose(cross), 0.0);
  const Ring stairs{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 3}, {2, 3}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
  expect_parts(stairs, decompose(stairs));
  expect_no_overlap(decompose(stairs), 0.0);
}

TEST(Decompose, CoversRandomPolygonsWithoutOverlap) {
  Random random(12);
  std::size_t reflex = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ring polygon = clean(random_simple(random, 4 + static_cast<int>(random() % 30))).vertices;
    if (polygon.empty()) continue;
    const auto parts = decompose(polygon);
    expect_parts(polygon, parts);
    expect_no_overlap(parts, 1e-14);
    ASSERT_LE(parts.size(), 2 * reflex_vertices(polygon) + 1) << "seed 12, " << i;
    reflex += reflex_vertices(polygon);
  }
  EXPECT_GT(reflex, 5000u);
}

TEST(Decompose, HoldsOnGriddedOutlinesFullOfStraightDiagonals) {
  Random random(13);
  int tried = 0;
  for (int i = 0; i < 40000; ++i) {
    Ring points;
    for (std::size_t n = 4 + random() % 9; points.size() < n;)
      points.push_back(Vec{static_cast<double>(random() % 5), static_cast<double>(random() % 5)});
    const Ring polygon = clean(points).vertices;
    if (polygon.empty()) continue;
    ++tried;
    expect_parts(polygon, decompose(polygon));
    expect_no_overlap(decompose(polygon), 1e-15);
  }
  EXPECT_GT(tried, 1000);
}

TEST(Decompose, CutsASquareFrameIntoFour) {
  const Rings frame{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}};
  const auto parts = decompose(frame);
  EXPECT_EQ(parts.size(), 4u);
  EXPECT_EQ(decompose(frame, 0.5)[3].radius, 0.5);
  expect_parts(frame, parts);
  expect_no_overlap(parts, 0.0);
}

TEST(Decompose, OfOneRingIsThatOfThePolygon) {
  const Ring polygon = star(30, 0.5);
  const auto one = decompose(polygon), other = decompose(Rings{polygon});
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].vertices, other[i].vertices);
}

// Bridges that share ends, run along one line, and stand above each other.
TEST(Decompose, BridgesHolesInARow) {
  for (const bool turned : {false, true}) {
    Rings rings{{{0, 0}, {9, 0}, {9, 3}, {0, 3}}};
    for (double x : {1.0, 3.0, 5.0, 7.0}) rings.push_back({{x, 1}, {x + 0.5, 2}, {x + 1, 1}});
    if (turned)
      for (Ring& ring : rings)
        for (Vec& v : ring) v = {-v.y(), v.x()};
    expect_parts(rings, decompose(rings));
    expect_no_overlap(decompose(rings), 1e-14);
  }
}

TEST(Decompose, LeavesHolesOutOnAGridFullOfStraightLines) {
  Random random(14);
  std::size_t holes = 0, inside = 0, outside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Rings rings = random_with_holes(random, 40);
    const auto parts = decompose(rings);
    expect_parts(rings, parts);
    expect_no_overlap(parts, 1e-14);
    std::size_t reflex = 0;
    for (const Ring& ring : rings) reflex += reflex_vertices(ring);
    ASSERT_LE(parts.size(), 2 * reflex + 1) << "seed 14, " << i;
    for (int k = 0; k < 20; ++k) {
      const Vec x = random_vec(random, 12, 12);
      const bool held = std::any_of(parts.begin(), parts.end(), [&](const Convex& part) {
        return separation(part, {}, disc(0.0, x), {}).distance <= 0.0;
      });
      ASSERT_EQ(held, is_inside(rings, x)) << "seed 14, " << i << ", " << x.transpose();
      ++(held ? inside : outside);
    }
    holes += rings.size() - 1;
  }
  EXPECT_GT(holes, 6000u);
  EXPECT_GT(inside, 10000u);
  EXPECT_GT(outside, 10000u);
}

TEST(Decompose, OfSixteenHundredHolesTakesNoMinutes) {
  const Rings rings = grating(40);
  const auto parts = decompose(rings);
  expect_parts(rings, parts);
  EXPECT_LE(parts.size(), 2 * 4 * (rings.size() - 1) + 1);
}

TEST(Decompose, OfALongSpiralTakesNoMinutes) {
  for (const Ring& polygon : {spiral(4000, 20), comb(4000), star(4000, 0.5)})
    expect_parts(polygon, decompose(polygon));
}

}  // namespace
}  // namespace throng::narrowphase
