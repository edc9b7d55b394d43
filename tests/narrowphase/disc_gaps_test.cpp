// SPDX-License-Identifier: MIT
#include "narrowphase/disc_gaps.h"

#include <gtest/gtest.h>

#include "narrowphase/distance.h"
#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

struct Columns {
  std::vector<double> x, y, radius;

  void add(double px, double py, double r) { x.push_back(px), y.push_back(py), radius.push_back(r); }
  Discs rows(std::size_t from = 0, std::size_t count = std::dynamic_extent) const {
    return {std::span(x).subspan(from, count), std::span(y).subspan(from, count),
            std::span(radius).subspan(from, count)};
  }
};

Columns random_discs(Random& random, std::size_t count, double range) {
  Columns c;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec p = random_vec(random, range, range);
    c.add(p.x(), p.y(), uniform(random, 0.1, 1.0));
  }
  return c;
}

TEST(FindGaps, GivesTheGapNormalAndWitnessOfEachRow) {
  Columns a, b;
  a.add(0, 0, 1), b.add(3, 4, 2);
  a.add(5, 5, 1), b.add(5, 5, 2);
  a.add(0, 2, 1), b.add(0, 0.5, 1);
  DiscGaps gaps;
  find_gaps(a.rows(), b.rows(), gaps);
  EXPECT_EQ(gaps.distance, (std::vector<double>{2.0, -3.0, -0.5}));
  EXPECT_DOUBLE_EQ(gaps.normal_x[0], 0.6);
  EXPECT_DOUBLE_EQ(gaps.normal_y[0], 0.8);
  EXPECT_DOUBLE_EQ(gaps.point_x[0], 0.6);
  EXPECT_DOUBLE_EQ(gaps.point_y[0], 0.8);
  EXPECT_EQ(gaps.normal_x[1], 1.0);
  EXPECT_EQ(gaps.normal_y[1], 0.0);
  EXPECT_EQ(gaps.normal_y[2], -1.0);
  EXPECT_EQ(gaps.point_y[2], 1.0);
}

TEST(FindGaps, OfNoRowsIsNone) {
  DiscGaps gaps{{1.0}, {1.0}, {1.0}, {1.0}, {1.0}};
  find_gaps({}, {}, gaps);
  EXPECT_TRUE(gaps.distance.empty());
  EXPECT_TRUE(gaps.point_y.empty());
}

TEST(FindGaps, AgreesWithTheSeparationOfEachPair) {
  for (double scale : {1e-6, 1.0, 1e6}) {
    Random random(1642);
    const Columns a = random_discs(random, 1003, 2 * scale), b = random_discs(random, 1003, 2 * scale);
    DiscGaps gaps;
    find_gaps(a.rows(), b.rows(), gaps);
    int overlapping = 0;
    for (std::size_t i = 0; i < a.x.size(); ++i) {
      const Separation s =
          separation(disc(a.radius[i]), {{a.x[i], a.y[i]}}, disc(b.radius[i]), {{b.x[i], b.y[i]}});
      ASSERT_NEAR(gaps.distance[i], s.distance, 4 * kUnitRoundoff * (4 * scale + 2)) << i;
      ASSERT_NEAR(gaps.normal_x[i], s.normal.x(), 8 * kUnitRoundoff) << i;
      ASSERT_NEAR(gaps.normal_y[i], s.normal.y(), 8 * kUnitRoundoff) << i;
      ASSERT_NEAR(gaps.point_x[i], s.point_a.x(), 8 * kUnitRoundoff * (2 * scale + 1)) << i;
      ASSERT_NEAR(gaps.point_y[i], s.point_a.y(), 8 * kUnitRoundoff * (2 * scale + 1)) << i;
      overlapping += s.distance < 0.0;
    }
    EXPECT_GT(overlapping, scale == 1e6 ? -1 : 100);
  }
}

// Equal bits, whichever lanes a row falls into.
TEST(FindGaps, GivesEachRowTheSameBitsInAnyCompany) {
  Random random(1643);
  const Columns a = random_discs(random, 37, 1.0), b = random_discs(random, 37, 1.0);
  DiscGaps all, alone;
  find_gaps(a.rows(), b.rows(), all);
  for (std::size_t i = 0; i < 37; ++i) {
    find_gaps(a.rows(i, 1), b.rows(i, 1), alone);
    EXPECT_EQ(all.distance[i], alone.distance[0]) << i;
    EXPECT_EQ(all.normal_x[i], alone.normal_x[0]) << i;
    EXPECT_EQ(all.normal_y[i], alone.normal_y[0]) << i;
    EXPECT_EQ(all.point_x[i], alone.point_x[0]) << i;
    EXPECT_EQ(all.point_y[i], alone.point_y[0]) << i;
  }
}

}  // namespace
}  // namespace throng::narrowphase
