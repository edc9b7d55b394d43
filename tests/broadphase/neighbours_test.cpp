// SPDX-License-Identifier: MIT
#include "broadphase/neighbours.h"

#include <gmock/gmock.h>

#include "broadphase/brute_force.h"
#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Neighbours = std::vector<Neighbour>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

PointGrid grid_of(const Points& points, double cell, const Period* period = nullptr) {
  PointGrid grid;
  grid.rebuild(points, cell, period);
  return grid;
}

Neighbours near(const PointGrid& grid, const Point& p, const Near& what,
                std::optional<std::uint32_t> except = {}) {
  Neighbours neighbours{{7, 7.0}};
  find_near(grid, p, what, neighbours, except);
  return neighbours;
}

TEST(Neighbours, AreSortedByDistanceThenRow) {
  const PointGrid grid = grid_of({{3, 4}, {0, 1}, {-1, 0}, {0, -1}, {9, 9}}, 1.0);
  const auto all = ElementsAre(Neighbour{1, 1.0}, Neighbour{2, 1.0}, Neighbour{3, 1.0}, Neighbour{0, 5.0});
  EXPECT_THAT(near(grid, {0, 0}, {5.0}), all);
  EXPECT_THAT(near(grid, {0, 0}, {5.0, 4}), all);
  EXPECT_THAT(near(grid, {0, 0}, {5.0, 2}), ElementsAre(Neighbour{1, 1.0}, Neighbour{2, 1.0}));
  EXPECT_THAT(near(grid, {0, 1}, {1.5}, 1), ElementsAre(Neighbour{2, std::sqrt(2.0)}));
}

TEST(Neighbours, AreNoneWhereNoneAre) {
  EXPECT_THAT(near(grid_of({}, 1.0), {0, 0}, {}), IsEmpty());
  EXPECT_THAT(near(grid_of({{1, 1}}, 1.0), {1, 1}, {}, 0), IsEmpty());
  EXPECT_THAT(near(grid_of({{1, 1}}, 1.0), {1, 1}, {kInfinity, 0}), IsEmpty());
}

TEST(Neighbours, SeeAcrossTheSeam) {
  const Period period{{0, 0}, {10, 10}};
  const PointGrid grid = grid_of({{9.5, 5}, {2, 5}, {5, 5}}, 1.0, &period);
  EXPECT_THAT(near(grid, {0.25, 5}, {3.0}), ElementsAre(Neighbour{0, 0.75}, Neighbour{1, 1.75}));
}

TEST(Neighbours, OfAPlaceFarAwayAreFound) {
  const PointGrid grid = grid_of({{0, 0}, {1, 0}, {0, 1}}, 1e-3);
  EXPECT_THAT(near(grid, {1e9, 0}, {kInfinity, 1}), ElementsAre(Neighbour{1, 1e9 - 1.0}));
  EXPECT_THAT(near(grid, {-1e9, 0}, {}), testing::SizeIs(3));
}

// Squared distances one bit apart have the same root: the smaller row comes first, on whichever side of a
// ring it is.
TEST(Neighbours, OfDistancesThatRoundToOneAreOrderedByRow) {
  Random random(2);
  int ties = 0;
  for (int round = 0; round < 3000; ++round) {
    const double turn = random.between(0.0, 6.28);
    const Points points{{std::sin(turn), std::cos(turn)}, {1.0, 0.0}, {-std::cos(turn), std::sin(turn)}};
    const double squared[3] = {points[0].squaredNorm(), 1.0, points[2].squaredNorm()};
    ties += squared[0] != squared[1] && std::sqrt(squared[0]) == 1.0;
    const PointGrid grid = grid_of(points, 1.0);
    for (std::size_t most = 1; most <= 3; ++most)
      EXPECT_EQ(near(grid, {0, 0}, {kInfinity, most}), brute_force::near(points, {0, 0}, {kInfinity, most}));
  }
  EXPECT_GT(ties, 100);
}

TEST(Neighbours, AgreeWithTheDefinition) {
  const std::uint64_t seed = 99;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  double found = 0.0, asked = 0.0;
  for (int round = 0; round < 300; ++round) {
    const double side = 12.0;
    Points points = cloud(random, 1 + random.below(200), side);
    const Period torus{{0, 0}, {side, side}};
    const Period* period = round % 3 == 1 ? &torus : nullptr;
    if (round % 3 == 2) points.push_back({-1e6, 1e6});
    const PointGrid grid = grid_of(points, random.between(0.05, 4.0), period);
    const Near what{round % 5 ? random.between(0.0, 8.0) : kInfinity,
                    round % 2 ? 1 + random.below(20) : points.size()};
    const Point p = round % 7 ? random.in_square(side) : points[0];
    const auto except = round % 14 ? std::nullopt : std::optional<std::uint32_t>(0);
    const Neighbours expected = brute_force::near(points, p, what, period, except);
    EXPECT_EQ(near(grid, p, what, except), expected) << "round " << round;
    found += static_cast<double>(expected.size());
    asked += static_cast<double>(points.size());
  }
  EXPECT_GT(found / asked, 0.1);
  EXPECT_LT(found / asked, 0.6);
}

}  // namespace
}  // namespace throng::broadphase
