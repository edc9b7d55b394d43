// SPDX-License-Identifier: MIT
#include "narrowphase/disc_union.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

using DiscList = std::vector<Disc>;

TEST(DiscUnion, OfOneDiscIsThatDisc) {
  const MassProperties m = mass_properties(DiscList{{{3, 4}, 2}});
  EXPECT_NEAR(m.area, 4 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(m.centroid.x(), 3, 1e-15);
  EXPECT_NEAR(m.gyration2, 2.0, 1e-15);
}

TEST(DiscUnion, OfDiscsApartIsTheirSum) {
  const MassProperties m = mass_properties(DiscList{{{-3, 0}, 1}, {{3, 0}, 2}});
  EXPECT_NEAR(m.area, 5 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(m.centroid.x(), (-3 + 4 * 3) / 5.0, 1e-14);
  const double c = m.centroid.x();
  EXPECT_NEAR(m.gyration2, ((0.5 + (c + 3) * (c + 3)) + 4 * (2.0 + (3 - c) * (3 - c))) / 5, 1e-13);
}

TEST(DiscUnion, OfTwoThatOverlapIsTheirSumLessTheLens) {
  const double lens =
      2 * std::numbers::pi / 3 - std::sqrt(3.0) / 2;  // of two unit discs, each through the other's centre
  const MassProperties m = mass_properties(DiscList{{{0, 0}, 1}, {{0, 1}, 1}});
  EXPECT_NEAR(m.area, 2 * std::numbers::pi - lens, 1e-14);
  EXPECT_NEAR(m.centroid.x(), 0.0, 1e-15);
  EXPECT_NEAR(m.centroid.y(), 0.5, 1e-15);
}

TEST(DiscUnion, CountsEqualAndHiddenDiscsOnce) {
  const MassProperties m = mass_properties(DiscList{{{0, 0}, 2}, {{0, 0}, 2}, {{0.5, 0}, 1}, {{1, 0}, 1}});
  EXPECT_NEAR(m.area, 4 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(m.gyration2, 2.0, 1e-14);
}

TEST(DiscUnion, OfTouchingDiscsIsTheirSum) {
  EXPECT_NEAR(mass_properties(DiscList{{{0, 0}, 1}, {{2, 0}, 1}, {{1, std::sqrt(3.0)}, 1}}).area,
              3 * std::numbers::pi, 1e-13);
}

/// The union cut into thin columns, each one exact.
MassProperties by_columns(const DiscList& discs, int columns) {
  double area = 0.0, ix = 0.0, iy = 0.0, second = 0.0;
  const double from = -3.0, width = 6.0 / columns;
  for (int k = 0; k < columns; ++k) {
    const double x = from + (k + 0.5) * width;
    std::vector<std::pair<double, double>> spans;
    for (const Disc& d : discs) {
      const double h2 = d.radius * d.radius - (x - d.centre.x()) * (x - d.centre.x());
      if (h2 > 0) spans.emplace_back(d.centre.y() - std::sqrt(h2), d.centre.y() + std::sqrt(h2));
    }
    std::sort(spans.begin(), spans.end());
    double end = -INFINITY;
    for (auto [low, high] : spans) {
      low = std::max(low, end);
      if (high <= low) continue;
      end = high;
      area += (high - low) * width, ix += x * (high - low) * width,
          iy += (high * high - low * low) / 2 * width;
      second += (x * x * (high - low) + (high * high * high - low * low * low) / 3) * width;
    }
  }
  const Vec c{ix / area, iy / area};
  return {area, c, second / area - c.squaredNorm()};
}

TEST(DiscUnion, IsThatOfThinColumns) {
  Random random(8);
  for (int i = 0; i < 60; ++i) {
    DiscList discs;
    for (std::size_t n = 1 + random() % 7; discs.size() < n;)
      discs.push_back({{uniform(random, -1, 1), uniform(random, -1, 1)}, uniform(random, 0.1, 1.5)});
    const MassProperties m = mass_properties(discs), expected = by_columns(discs, 20000);
    ASSERT_NEAR(m.area, expected.area, 2e-5) << "seed 8, " << i;
    ASSERT_NEAR((m.centroid - expected.centroid).norm(), 0.0, 2e-5) << "seed 8, " << i;
    ASSERT_NEAR(m.gyration2, expected.gyration2, 2e-5) << "seed 8, " << i;
  }
}

TEST(DiscUnion, DoesNotDependOnPlaceOrderOrScale) {
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    DiscList discs;
    for (std::size_t n = 2 + random() % 5; discs.size() < n;)
      discs.push_back({{uniform(random, -1, 1), uniform(random, -1, 1)}, uniform(random, 0.1, 1.5)});
    const MassProperties m = mass_properties(discs);
    DiscList moved;
    for (std::size_t k = discs.size(); k-- > 0;)
      moved.push_back({1e-3 * Vec(-discs[k].centre.y(), discs[k].centre.x()), 1e-3 * discs[k].radius});
    const MassProperties other = mass_properties(moved);
    ASSERT_NEAR(other.area * 1e6 / m.area, 1.0, 1e-12) << "seed 9, " << i;
    ASSERT_NEAR(other.gyration2 * 1e6 / m.gyration2, 1.0, 1e-12) << "seed 9, " << i;
  }
}

}  // namespace
}  // namespace throng::narrowphase
