// SPDX-License-Identifier: MIT
// The lists of all points at once, against their definition.
#include "broadphase/all_lists.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <rapidcheck/gtest.h>
#include <limits>

#include "broadphase/brute_force.h"
#include "broadphase/cell_order.h"
#include "tests/broadphase/clouds.h"
#include "tests/broadphase/least_seconds.h"
#include "tests/broadphase/list.h"
#include "tests/less_when_watched.h"

namespace throng::broadphase {
namespace {

using Neighbours = std::vector<Neighbour>;

void expect_equal(const NeighbourLists& a, const NeighbourLists& b) {
  EXPECT_EQ(a.begin, b.begin);
  EXPECT_EQ(a.row, b.row);
  EXPECT_EQ(a.distance, b.distance);
}

/// Compares every list with its definition; returns how many neighbours there are.
std::size_t expect_definition(const Points& points, std::span<const double> radius, const Period* period,
                              const NeighbourLists& lists) {
  EXPECT_EQ(lists.size(), points.size());
  for (std::uint32_t row = 0; row < lists.size(); ++row)
    EXPECT_EQ(list(lists, row),
              brute_force::near(points, Place{points[row], {0, 0}, row}, {.radius = radius[row]}, period))
        << "row " << row;
  return lists.row.size();
}

TEST(AllLists, AreSortedByDistanceThenRow) {
  const Points points{{0, 0}, {3, 4}, {0, 1}, {-1, 0}, {9, 9}};
  NeighbourLists lists;
  AllLists().find(points, 5.0, nullptr, lists);
  EXPECT_EQ(list(lists, 0), (Neighbours{{2, 1.0}, {3, 1.0}, {1, 5.0}}));
  EXPECT_EQ(list(lists, 4), Neighbours{});
  AllLists().find(points, std::vector<double>{1.0, 5.0, 0.5, 2.0, 100.0}, nullptr, lists);
  EXPECT_EQ(list(lists, 0), (Neighbours{{2, 1.0}, {3, 1.0}}));
  EXPECT_EQ(list(lists, 1), (Neighbours{{2, std::sqrt(18.0)}, {0, 5.0}}));
  EXPECT_EQ(list(lists, 2), Neighbours{});
  EXPECT_EQ(list(lists, 4).size(), 4u);
}

TEST(AllLists, AreEmptyWhereNobodyIs) {
  NeighbourLists lists{{7}, {7}, {7.0}};
  AllLists search;
  search.find(Points{}, 1.0, nullptr, lists);
  EXPECT_EQ(lists.size(), 0u);
  EXPECT_TRUE(lists.row.empty());
  search.find(Points{}, std::vector<double>{}, nullptr, lists);
  EXPECT_EQ(lists.size(), 0u);
  search.find(Points{{1, 1}}, std::numeric_limits<double>::infinity(), nullptr, lists);
  EXPECT_EQ(lists.begin, (std::vector<std::size_t>{0, 0}));
}

TEST(AllLists, HoldThoseInTheSamePlaceAtNoDistance) {
  NeighbourLists lists;
  AllLists().find(Points(300, Point(3.0, 4.0)), 0.0, nullptr, lists);
  for (std::uint32_t row = 0; row < 300; ++row) {
    const Neighbours all = list(lists, row);
    ASSERT_EQ(all.size(), 299u);
    for (std::uint32_t k = 0; k < 299; ++k) EXPECT_EQ(all[k], (Neighbour{k + (k >= row), 0.0}));
  }
}

TEST(AllLists, ReachAcrossTheSeamHoweverFar) {
  const Period period{{0, 0}, {10, 10}};
  const Points points{{9.5, 5}, {2, 5}, {5, 5}, {0.25, 10}, {0.25, 0}};
  NeighbourLists lists;
  for (const double radius : {0.0, 0.5, 2.5, 3.0, 3.5, 5.0, 50.0, std::numeric_limits<double>::infinity()}) {
    AllLists().find(points, radius, &period, lists);
    expect_definition(points, std::vector<double>(5, radius), &period, lists);
  }
}

// With cells of 1 these two lie in cells 0 and 2, and yet their rounded distance is exactly 1.
TEST(AllLists, HoldWhatRoundingBringsWithinReach) {
  NeighbourLists lists;
  AllLists().find(Points{{0.0, 0.0}, {0.99999999999999989, 0.0}, {2.0, 0.0}}, 1.0, nullptr, lists);
  EXPECT_EQ(list(lists, 2), (Neighbours{{1, 1.0}}));
}

class AllListsOnEachTarget : public testing::TestWithParam<std::int64_t> {
 protected:
  AllListsOnEachTarget() { hwy::SetSupportedTargetsForTest(GetParam()); }
  ~AllListsOnEachTarget() override { hwy::SetSupportedTargetsForTest(0); }
};

INSTANTIATE_TEST_SUITE_P(All, AllListsOnEachTarget, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

TEST_P(AllListsOnEachTarget, AgreeWithTheDefinition) {
  const std::uint64_t seed = 17;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  AllLists one, two(2);
  double found = 0.0, asked = 0.0;
  for (const Spread how : kSpreads)
    for (const bool periodic : {false, true})
      for (const double offset : {0.0, 1e9, -1e9})
        for (const std::size_t n : std::initializer_list<std::size_t>{1, 2, 9, 70, less_when_watched(500)})
          for (const double radius : {0.0, 0.05, 0.7, 4.0, 9.0, std::numeric_limits<double>::infinity()}) {
            const Point origin(offset, -0.5 * offset);
            const Period period{origin, Point(16.0, 16.0)};
            Points points = moved(spread(random, how, n, 16.0), origin);
            if (periodic)
              for (Point& p : points) p = p.cwiseMin(period.origin + period.size);
            std::vector<double> own;
            for (std::size_t i = 0; i < n; ++i)
              own.push_back(random.below(9) ? radius : std::min(1.0, radius) * random.unit());
            SCOPED_TRACE(testing::Message() << "spread " << static_cast<int>(how) << ", periodic " << periodic
                                            << ", offset " << offset << ", n " << n << ", radius " << radius);
            const Period* where = periodic ? &period : nullptr;
            NeighbourLists lists, again;
            one.find(points, radius, where, lists);
            two.find(points, radius, where, again);
            expect_equal(lists, again);
            const std::vector<double> same(n, radius);
            found += static_cast<double>(expect_definition(points, same, where, lists)) /
                     static_cast<double>(n * n);
            asked += 1.0;
            one.find(points, own, where, lists);
            two.find(points, own, where, again);
            expect_equal(lists, again);
            expect_definition(points, own, where, lists);
            if (HasFailure()) return;
          }
  EXPECT_GT(found / asked, 0.1);
  EXPECT_LT(found / asked, 0.7);
}

// Crowds of one scale get a grid; a crowd that one has left, and blobs far apart, the tree.
TEST(AllLists, UseAGridWhereItsCellsAreFilled) {
  Random random(3);
  Team team(1);
  CellOrder cells;
  const Period period{{0, 0}, {100, 100}};
  Points crowd = spread(random, Spread::uniform, 5000, 100.0);
  EXPECT_TRUE(cells.rebuild(crowd, 2.0, nullptr, team));
  EXPECT_TRUE(cells.rebuild(crowd, 0.1, nullptr, team));
  EXPECT_TRUE(cells.rebuild(crowd, 0.0, &period, team));
  EXPECT_FALSE(cells.rebuild(spread(random, Spread::clustered, 5000, 1e5), 1.0, nullptr, team));
  crowd.push_back({1e9, 0});
  EXPECT_FALSE(cells.rebuild(crowd, 2.0, nullptr, team));
  NeighbourLists lists;
  AllLists().find(crowd, 2.0, nullptr, lists);
  expect_definition(crowd, std::vector<double>(crowd.size(), 2.0), nullptr, lists);
}

// Half look far and stand apart, half see only who touches them and stand in a heap: the mean square of the
// radii once chose cells as wide as the farthest look, and in them all pairs of the heap were met.
TEST(AllLists, DontMeetAllPairsOfAHeapThatLooksNowhere) {
  constexpr std::size_t kHalf = 30000;
  Random random(5);
  Points points;
  std::vector<double> radius;
  for (std::size_t i = 0; i < 2 * kHalf; ++i) {
    points.push_back(i % 2 ? random.in_square(300.0) : Point(0.5 * random.in_square(1.0)));
    radius.push_back(i % 2 ? 1.0 : 1e-5);
  }
  AllLists search;
  NeighbourLists lists;
  NeighbourSearch walk;
  ProximityTree tree;
  const double usual = least_seconds([&] {
    tree.build(points);
    walk.find(tree, {.at = points, .radius = radius, .own = 0}, {}, lists);
  });
  const NeighbourLists expected = lists;
  EXPECT_LT(least_seconds([&] { search.find(points, radius, nullptr, lists); }), 5.0 * usual + 0.05);
  expect_equal(lists, expected);
  EXPECT_GT(lists.row.size(), kHalf);
}

TEST(AllLists, OfPermutedPointsAreThePermutedLists) {
  Random random(11);
  const Points points = spread(random, Spread::uniform, 600, 20.0);  // none equally near
  std::vector<std::uint32_t> from(points.size());
  for (std::uint32_t i = 0; i < from.size(); ++i) from[i] = i;
  random.shuffle(from);
  Points permuted;
  for (const std::uint32_t row : from) permuted.push_back(points[row]);
  NeighbourLists straight, turned;
  AllLists().find(points, 2.0, nullptr, straight);
  AllLists().find(permuted, 2.0, nullptr, turned);
  for (std::size_t i = 0; i < from.size(); ++i) {
    Neighbours renamed = list(turned, i);
    for (Neighbour& n : renamed) n.row = from[n.row];
    EXPECT_EQ(renamed, list(straight, from[i]));
  }
}

RC_GTEST_PROP(AllLists, AgreeWithTheDefinitionOnWholeNumbers, ()) {
  // Small whole coordinates: ties, coincidences and borders abound.
  const auto xs = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-4, 5));
  const auto ys = *rc::gen::container<std::vector<int>>(xs.size(), rc::gen::inRange(-4, 5));
  const bool periodic = *rc::gen::arbitrary<bool>();
  const double radius = *rc::gen::inRange(0, 7);
  const Period period{{-4, -4}, {8, 8}};
  Points points;
  for (std::size_t i = 0; i < xs.size(); ++i) points.push_back({xs[i], ys[i]});
  NeighbourLists lists;
  AllLists().find(points, radius, periodic ? &period : nullptr, lists);
  for (std::uint32_t row = 0; row < points.size(); ++row)
    RC_ASSERT(list(lists, row) == brute_force::near(points, Place{points[row], {0, 0}, row},
                                                    {.radius = radius}, periodic ? &period : nullptr));
}

}  // namespace
}  // namespace throng::broadphase
