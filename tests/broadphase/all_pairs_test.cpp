// SPDX-License-Identifier: MIT
#include "broadphase/all_pairs.h"

#include <gmock/gmock.h>

#include "broadphase/brute_force.h"
#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Pairs = std::vector<Pair>;

Pairs ascending(const PairList& found, std::size_t rows) {
  Pairs pairs{{7, 7}};  // what stood there before is replaced
  HigherRows higher;
  higher.assign(found, rows);
  higher.write(pairs);
  return pairs;
}

Pairs pairs_of(const Points& points, double reach, const Period* period = nullptr) {
  PairList found;
  AllPairs().find(points, reach, period, found);
  return ascending(found, points.size());
}

void expect_brute_force(const Points& points, double reach, const Period* period = nullptr) {
  EXPECT_EQ(pairs_of(points, reach, period), brute_force::pairs(points, reach, period));
}

TEST(AllPairs, FindsThePairsThatPaperFinds) {
  // 0 and 1 are 5 apart, 1 and 2 are 1 apart, 3 is far away.
  EXPECT_THAT(pairs_of({{0, 0}, {3, 4}, {3, 5}, {50, 50}}, 5.0), ElementsAre(Pair{0, 1}, Pair{1, 2}));
  EXPECT_THAT(pairs_of({{0, 0}, {3, 4}, {3, 5}, {50, 50}}, 4.9), ElementsAre(Pair{1, 2}));
}

TEST(AllPairs, FindsNothingAmongNoneOrOne) {
  EXPECT_THAT(pairs_of({}, 1.0), IsEmpty());
  EXPECT_THAT(pairs_of({{3, 4}}, 1.0), IsEmpty());
  const Period period{{0, 0}, {10, 10}};
  EXPECT_THAT(pairs_of({}, 1.0, &period), IsEmpty());
  EXPECT_THAT(pairs_of({{3, 4}}, 5.0, &period), IsEmpty());
}

TEST(AllPairs, MeetsNoPointAsItsOwnNeighbourRoundANarrowPeriod) {
  for (const double reach : {1.0, 0.9, 0.6, 0.51, 0.5, 0.4, 0.34}) {
    const Period period{{0, 0}, {2, 2}};
    expect_brute_force({{0.1, 0.1}, {1.9, 1.9}, {1, 1}, {0, 2}, {2, 0}, {1.3, 0.7}}, reach, &period);
  }
}

TEST(AllPairs, SeesAcrossTheSeam) {
  const Period period{{-5, 100}, {10, 20}};
  EXPECT_THAT(pairs_of({{-4.9, 100.1}, {4.9, 119.9}, {0, 110}}, 0.3, &period), ElementsAre(Pair{0, 1}));
  EXPECT_THAT(pairs_of({{-5, 100}, {5, 120}}, 0.0, &period),
              ElementsAre(Pair{0, 1}));  // one place, two names
}

// With cells of 1 these lie in cells 0 and 2, and yet their distance in double is 1.
TEST(AllPairs, FindsThePairThatRoundingBringsWithinReach) {
  const double below_one = std::nextafter(1.0, 0.0);
  ASSERT_EQ(2.0 - below_one, 1.0);
  EXPECT_THAT(pairs_of({{below_one, 0}, {2, 0}, {0, 0}}, 1.0), ElementsAre(Pair{0, 1}, Pair{0, 2}));
  EXPECT_THAT(pairs_of({{0, 2}, {0, below_one}, {0, 0}}, 1.0), ElementsAre(Pair{0, 1}, Pair{1, 2}));
}

TEST(AllPairs, FindsPairsThatRoundingBringsWithinReachFarOut) {
  Random random(11);
  for (int round = 0; round < 2000; ++round) {
    const double reach = random.between(0.5, 3.0), start = random.between(-4.0, 4.0) * reach;
    Points points;  // a chain of steps that are the reach up to a few bits
    for (int link = 0; link < 8; ++link) {
      const double x = points.empty() ? start : points.back().x() + reach;
      points.push_back({x + (random.unit() - 0.5) * 0x1p-50 * std::abs(x), start});
    }
    expect_brute_force(points, reach);
  }
}

/// Pairs apart from one another, rows 2 i and 2 i + 1, each as far apart as the two reach but for rounding;
/// all across the seam where there is a period.
Points borderline_pairs(std::span<const double> reach, const Period* period, Random& random) {
  Points points;
  for (std::size_t row = 0; row < reach.size(); row += 2) {
    const double angle =
        0.25 * 3.141592653589793 + random.between(-0.2, 0.2);  // rounding is worst about here
    const double right = period ? period->origin.x() + period->size.x() : 0.0;
    const Point first(right - random.between(0.05, 0.3), 2.0 * static_cast<double>(row) + random.unit());
    Point second = first + (reach[row] + reach[row + 1]) * Point(std::cos(angle), std::sin(angle));
    if (period) second.x() -= period->size.x();
    points.insert(points.end(), {first, second});
  }
  return points;
}

TEST(AllPairs, DecidesInDoubleWhatFixedPointCannotTell) {
  Random random(12);
  for (const bool periodic : {false, true})
    for (const bool same_reach : {false, true})
      for (int round = 0; round < 20; ++round) {
        constexpr std::uint32_t kRows = 4000;
        // Cells that are longer along y, so that the period along x is no whole number of units.
        const Period seam{{0, 0}, {random.between(8.0, 8.0005), 2.0 * kRows + 4.9}};
        const Period* const period = periodic ? &seam : nullptr;
        std::vector<double> reach;
        for (std::uint32_t row = 0; row < kRows; ++row)
          reach.push_back(same_reach ? 0.5 : random.between(0.35, 0.5));
        const Points points = borderline_pairs(reach, period, random);
        Pairs near;
        for (std::uint32_t row = 0; row < kRows; row += 2) {
          const double most = reach[row] + reach[row + 1];
          if (squared_distance(points[row], points[row + 1], period) <= most * most)
            near.push_back({row, row + 1});
        }
        EXPECT_GT(near.size(), kRows / 20);
        EXPECT_LT(near.size(), kRows / 2 - kRows / 20);
        PairList found;
        AllPairs().find_discs(points, reach, period, found);
        EXPECT_EQ(ascending(found, kRows), near);
        HigherRows higher;
        AllPairs().find_discs(points, reach, period, higher);
        Pairs by_rows;
        higher.write(by_rows);
        EXPECT_EQ(by_rows, near);
        if (same_reach) {
          EXPECT_EQ(pairs_of(points, 1.0, period), near);
        }
      }
}

// A row of cells so long that it can't have buckets of its own: then cells share some. A pair must not be met
// in both.
TEST(AllPairs, ReportsAPairOnceWhereCellsShareABucket) {
  Random random(5);
  std::size_t found = 0;
  for (int round = 0; round < 3000; ++round) {
    Points points{{-1e6, -1e6}, {1e6, 1e6}};
    for (int i = 0; i < 30; ++i) points.push_back(random.in_square(6.0));
    expect_brute_force(points, 1.0);
    found += pairs_of(points, 1.0).size();
  }
  EXPECT_GT(found, 30000u);  // about 3,000 * 435 * pi / 36
}

TEST(AllPairs, AgreesWithTheDefinitionOnClouds) {
  const std::uint64_t seed = 20240601;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  double near = 0.0, all = 0.0;
  for (int round = 0; round < 300; ++round) {
    const std::size_t n = 1 + random.below(200);
    const double side = random.between(1.0, 12.0);
    const Points points = cloud(random, n, side);
    const double reach = round % 3 == 0 ? 1.0 : random.between(0.0, 0.5 * side);
    expect_brute_force(points, reach);
    const Period period{{0, 0}, {side, side}};
    if (2.0 * reach <= side) expect_brute_force(points, reach, &period);
    near += static_cast<double>(pairs_of(points, reach).size());
    all += 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
  }
  EXPECT_GT(near / all, 0.03);  // the sample tells near from far
  EXPECT_LT(near / all, 0.5);
}

TEST(AllPairs, AgreesWithTheDefinitionFarFromTheOrigin) {
  Random random(77);
  const Points points = cloud(random, 400, 12.0);
  for (const double offset : {-3.0, 1e3, -1e6, 1e9, -1e12}) {
    const Points there = moved(points, {offset, -0.3 * offset});
    expect_brute_force(there, 1.0);
    expect_brute_force(there, 0.1);
    const Period period{{offset, -0.3 * offset}, {12.5, 13.5}};
    if (std::abs(offset) < 1e11) expect_brute_force(there, 1.0, &period);
    Points both = points;  // here and there at once: as many cells between as a number can count
    both.insert(both.end(), there.begin(), there.end());
    expect_brute_force(both, 1.0);
    expect_brute_force(both, 1e-6);
  }
}

TEST(AllPairs, AgreesWithTheDefinitionInUnitsFromMicrometresToGigametres) {
  Random random(78);
  for (const double unit : {1e-9, 1e-6, 1e-3, 1e3, 1e9}) {
    Points points = cloud(random, 300, 12.0);
    for (Point& p : points) p *= unit;
    expect_brute_force(points, unit);
    const Period period{{0, 0}, Point(12.0 * unit, 12.0 * unit)};
    expect_brute_force(points, unit, &period);
  }
}

TEST(AllPairs, AgreesWithTheDefinitionOnALine) {
  Random random(9);
  for (const Point& step :
       {Point(1, 0), Point(0, 1), Point(1, 1), Point(-1, 2), Point(1024, 0), Point(0, 4096)}) {
    Points points;
    for (int i = 0; i < 300; ++i) points.push_back(std::floor(random.between(-200, 200)) * step);
    expect_brute_force(points, 1.0);
    expect_brute_force(points, 2.0 * step.norm());
  }
}

TEST(AllPairs, AgreesWithTheDefinitionOnALatticeOfCellBorders) {
  Points points;
  for (int x = -9; x <= 9; ++x)
    for (int y = -9; y <= 9; ++y) points.push_back({x, y});
  expect_brute_force(points, 1.0);
  expect_brute_force(points, std::sqrt(2.0));
  EXPECT_EQ(pairs_of(points, 1.0).size(), 2u * 18u * 19u);
  const Period period{{-9, -9}, {19, 19}};
  EXPECT_EQ(pairs_of(points, 1.0, &period).size(), 2u * 19u * 19u);
}

TEST(AllPairs, ReachOfZeroFindsTheCoincidentOnly) {
  EXPECT_THAT(pairs_of({{1, 1}, {2, 2}, {1, 1}, {1, std::nextafter(1.0, 2.0)}, {2, 2}}, 0.0),
              ElementsAre(Pair{0, 2}, Pair{1, 4}));
  EXPECT_THAT(pairs_of({{1, 1}, {1, 1}, {1, 1}}, 0.0), ElementsAre(Pair{0, 1}, Pair{0, 2}, Pair{1, 2}));
  EXPECT_THAT(pairs_of({{0.0, 1}, {-0.0, 1}}, 0.0), ElementsAre(Pair{0, 1}));
}

TEST(AllPairs, FindsEachPairOnceWhereHundredsCoincide) {
  const std::size_t crowd = 800;
  Points points;
  for (std::size_t i = 0; i < crowd; ++i) points.insert(points.end(), {Point(1, 1), Point(400.5, -3)});
  EXPECT_EQ(pairs_of(points, 0.5).size(), crowd * (crowd - 1));
  expect_brute_force(points, 0.5);
}

TEST(AllPairs, RenamesItsPairsAsTheRowsAreRenamed) {
  Random random(31);
  const Points points = cloud(random, 500, 10.0);
  std::vector<std::uint32_t> name(points.size());
  for (std::uint32_t i = 0; i < name.size(); ++i) name[i] = i;
  random.shuffle(name);
  Points renamed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) renamed[name[i]] = points[i];
  Pairs expected = pairs_of(points, 1.0);
  for (Pair& pair : expected)
    pair = {std::min(name[pair.a], name[pair.b]), std::max(name[pair.a], name[pair.b])};
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(pairs_of(renamed, 1.0), expected);
  EXPECT_GT(expected.size(), 1000u);
}

}  // namespace
}  // namespace throng::broadphase
