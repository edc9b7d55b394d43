// SPDX-License-Identifier: MIT
#include "narrowphase/decompose.h"

#include <gtest/gtest.h>

#include "narrowphase/distance.h"
#include "narrowphase/orientation.h"
#include "narrowphase/polygon.h"
#include "polygons.h"

namespace throng::narrowphase {
namespace {

using Points = std::vector<Vec>;

/// What every decomposition must be: convex parts, no overlap, all of the area.
void expect_parts(const Points& polygon, const std::vector<Convex>& parts) {
  double area = 0.0;
  for (const Convex& part : parts) {
    const std::size_t n = part.vertices.size();
    ASSERT_GE(n, 3u);
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_EQ(orientation(part.vertices[i], part.vertices[(i + 1) % n], part.vertices[(i + 2) % n]), 1);
    area += mass_properties(part.vertices).area;
  }
  const double whole = mass_properties(polygon).area;
  EXPECT_NEAR(area / whole, 1.0, 1e-12);
}

void expect_no_overlap(const std::vector<Convex>& parts, double tolerance) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_GE(separation(parts[i], {}, parts[j], {}).distance, -tolerance);
}

std::size_t reflex_vertices(const Points& polygon) {
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
  const Points polygon{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  const auto parts = decompose(polygon);
  EXPECT_EQ(parts.size(), 2u);
  expect_parts(polygon, parts);
}

TEST(Decompose, CopesWithVerticesThatEveryDiagonalRunsAlong) {
  const Points cross{{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                     {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  expect_parts(cross, decompose(cross));
  expect_no_overlap(decompose(cross), 0.0);
  const Points stairs{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 3}, {2, 3}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
  expect_parts(stairs, decompose(stairs));
  expect_no_overlap(decompose(stairs), 0.0);
}

TEST(Decompose, CoversRandomPolygonsWithoutOverlap) {
  Random random(12);
  std::size_t reflex = 0;
  for (int i = 0; i < 2000; ++i) {
    const Points polygon = clean(random_simple(random, 4 + static_cast<int>(random() % 30))).vertices;
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
    Points points;
    for (std::size_t n = 4 + random() % 9; points.size() < n;)
      points.push_back(Vec{static_cast<double>(random() % 5), static_cast<double>(random() % 5)});
    const Points polygon = clean(points).vertices;
    if (polygon.empty()) continue;
    ++tried;
    expect_parts(polygon, decompose(polygon));
    expect_no_overlap(decompose(polygon), 1e-15);
  }
  EXPECT_GT(tried, 1000);
}

TEST(Decompose, OfALongSpiralTakesNoMinutes) {
  for (const Points& polygon : {spiral(4000, 20), comb(4000), star(4000, 0.5)})
    expect_parts(polygon, decompose(polygon));
}

}  // namespace
}  // namespace throng::narrowphase
