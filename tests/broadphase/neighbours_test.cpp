// SPDX-License-Identifier: MIT
#include "broadphase/neighbours.h"

#include <gmock/gmock.h>

#include <limits>

#include "broadphase/brute_force.h"
#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Neighbours = std::vector<Neighbour>;

ProximityTree tree_of(const Points& points, const Period* period = nullptr) {
  ProximityTree tree;
  tree.build(points, period);
  return tree;
}

Neighbours near(const ProximityTree& tree, const Place& place, const Near& what) {
  Neighbours neighbours{{7, 7.0}};
  find_near(tree, place, what, neighbours);
  return neighbours;
}

std::vector<std::uint32_t> rows(const Neighbours& neighbours) {
  std::vector<std::uint32_t> result;
  for (const Neighbour& n : neighbours) result.push_back(n.row);
  return result;
}

TEST(Neighbours, AreSortedByDistanceThenRow) {
  const ProximityTree tree = tree_of({{3, 4}, {0, 1}, {-1, 0}, {0, -1}, {9, 9}});
  const auto all = ElementsAre(Neighbour{1, 1.0}, Neighbour{2, 1.0}, Neighbour{3, 1.0}, Neighbour{0, 5.0});
  EXPECT_THAT(near(tree, {{0, 0}}, {5.0}), all);
  EXPECT_THAT(near(tree, {{0, 0}}, {5.0, 4}), all);
  EXPECT_THAT(near(tree, {{0, 0}}, {5.0, 2}), ElementsAre(Neighbour{1, 1.0}, Neighbour{2, 1.0}));
  EXPECT_THAT(near(tree, {{0, 1}, {0, 0}, 1}, {1.5}), ElementsAre(Neighbour{2, std::sqrt(2.0)}));
}

TEST(Neighbours, AreNoneWhereNoneAre) {
  EXPECT_THAT(near(tree_of({}), {{0, 0}}, {}), IsEmpty());
  EXPECT_THAT(near(tree_of({}), {{0, 0}}, {.most = 1}), IsEmpty());
  EXPECT_THAT(near(tree_of({{1, 1}}), {{1, 1}, {0, 0}, 0}, {}), IsEmpty());
  EXPECT_THAT(near(tree_of({{1, 1}}), {{1, 1}}, {.most = 0}), IsEmpty());
  EXPECT_THAT(near(tree_of({{1, 1}}), {{1, 2}}, {.radius = 0.0}), IsEmpty());
}

TEST(Neighbours, AtNoDistanceAreThoseInTheSamePlace) {
  EXPECT_THAT(near(tree_of({{1, 1}, {2, 2}, {1, 1}}), {{1, 1}}, {.radius = 0.0}),
              ElementsAre(Neighbour{0, 0.0}, Neighbour{2, 0.0}));
  const ProximityTree heap = tree_of(Points(1000, Point(3.0, 4.0)));
  EXPECT_THAT(near(heap, {{0, 0}, {0, 0}, 1}, {.most = 2}),
              ElementsAre(Neighbour{0, 5.0}, Neighbour{2, 5.0}));
  EXPECT_THAT(near(heap, {{0, 0}}, {}), testing::SizeIs(1000));
  EXPECT_EQ(near(heap, {{0, 0}}, {.most = 100}).back(), (Neighbour{99, 5.0}));
}

TEST(Neighbours, SeeAcrossTheSeamHoweverFarTheyLook) {
  const Period period{{0, 0}, {10, 10}};
  const ProximityTree tree = tree_of({{9.5, 5}, {2, 5}, {5, 5}}, &period);
  EXPECT_THAT(near(tree, {{0.25, 5}}, {3.0}), ElementsAre(Neighbour{0, 0.75}, Neighbour{1, 1.75}));
  // Beyond half the period: each once, at its nearest image.
  EXPECT_THAT(near(tree, {{0.25, 5}}, {50.0}),
              ElementsAre(Neighbour{0, 0.75}, Neighbour{1, 1.75}, Neighbour{2, 4.75}));
}

TEST(Neighbours, OfAPlaceFarAwayAreFound) {
  const ProximityTree tree = tree_of({{0, 0}, {1, 0}, {0, 1}});
  EXPECT_THAT(near(tree, {{1e9, 0}}, {std::numeric_limits<double>::infinity(), 1}),
              ElementsAre(Neighbour{1, 1e9 - 1.0}));
  EXPECT_THAT(near(tree, {{-1e9, 0}}, {}), testing::SizeIs(3));
}

TEST(Neighbours, AreToldByTheirGroups) {
  const Points points{{1, 0}, {2, 0}, {3, 0}, {4, 0}};
  const std::vector<std::uint32_t> groups{1, 2, 3, 4};
  ProximityTree tree;
  tree.build(points, nullptr, groups);
  EXPECT_THAT(rows(near(tree, {{0, 0}}, {.groups = 2})), ElementsAre(1, 2));
  EXPECT_THAT(rows(near(tree, {{0, 0}}, {.most = 1, .groups = 4})), ElementsAre(3));
  EXPECT_THAT(near(tree, {{0, 0}}, {.groups = 8}), IsEmpty());
}

TEST(Neighbours, OfDiscsAreMeasuredToTheRim) {
  ProximityTree tree;
  tree.build(Points{{10, 0}, {0, 4}, {0.5, 0}}, std::vector<double>{9.0, 1.0, 2.0});
  EXPECT_THAT(near(tree, {{0, 0}}, {.radius = 3.0}),
              ElementsAre(Neighbour{2, -1.5}, Neighbour{0, 1.0}, Neighbour{1, 3.0}));
  EXPECT_THAT(near(tree, {{0, 0}}, {.most = 1}), ElementsAre(Neighbour{2, -1.5}));
}

TEST(Neighbours, OfBoxesAreMeasuredToTheNearestPoint) {
  ProximityTree tree;
  tree.build(std::vector<Box>{
      {Point(3, 4), Point(9, 9)}, {Point(-1, -1), Point(1, 1)}, {Point(2, -5), Point(4, 5)}});
  EXPECT_THAT(near(tree, {{0, 0}}, {.radius = 5.0}),
              ElementsAre(Neighbour{1, 0.0}, Neighbour{2, 2.0}, Neighbour{0, 5.0}));
}

const double kSqrtHalf = std::sqrt(0.5);

TEST(FieldOfView, EndsAtItsBorderWhichBelongsToIt) {
  const ProximityTree tree = tree_of({{2, 2}, {2, -2}, {2, 2.0000000000000004}, {-3, 0}, {0, 0}, {5, 0}});
  const Near quarter{.view = {kSqrtHalf, kSqrtHalf}};  // 90 degrees
  EXPECT_THAT(rows(near(tree, {{0, 0}, {1, 0}}, quarter)), ElementsAre(4, 0, 1, 5));
  EXPECT_THAT(rows(near(tree, {{0, 0}, {7, 0}}, quarter)), ElementsAre(4, 0, 1, 5));
  const Near half{.view = {0.0, 1.0}};
  EXPECT_THAT(rows(near(tree, {{0, 0}, {0, -1}}, half)), ElementsAre(4, 1, 3, 5));
}

TEST(FieldOfView, ShowsWhatIsExactlyBehindOnlyAllAround) {
  const ProximityTree tree = tree_of({{-3, 0}, {-3, 1}});
  const Near wide{.view = {-0.99999999999999, 1.4e-7}};
  EXPECT_THAT(rows(near(tree, {{0, 0}, {1, 0}}, wide)), ElementsAre(1));
  EXPECT_THAT(rows(near(tree, {{0, 0}, {1, 0}}, {})), ElementsAre(0, 1));
  EXPECT_THAT(rows(near(tree, {{0, 0}, {0, 0}}, wide)), ElementsAre(0, 1));  // who heads nowhere
}

// Squared distances one bit apart have the same root: the smaller row comes first.
TEST(Neighbours, OfDistancesThatRoundToOneAreOrderedByRow) {
  Random random(2);
  int ties = 0;
  for (int round = 0; round < 3000; ++round) {
    const double turn = random.between(0.0, 6.28);
    Points points{{std::sin(turn), std::cos(turn)}, {1.0, 0.0}, {-std::cos(turn), std::sin(turn)}};
    const double squared[3] = {points[0].squaredNorm(), 1.0, points[2].squaredNorm()};
    ties += squared[0] != squared[1] && std::sqrt(squared[0]) == 1.0;
    for (int far = 0; far < 30; ++far) points.push_back({5.0, far});  // so that there are leaves
    const ProximityTree tree = tree_of(points);
    for (std::size_t most = 1; most <= 3; ++most)
      EXPECT_EQ(near(tree, {{0, 0}}, {std::numeric_limits<double>::infinity(), most}),
                brute_force::near(points, {{0, 0}}, {std::numeric_limits<double>::infinity(), most}));
  }
  EXPECT_GT(ties, 100);
}

// Whoever stands at the edge of a large crowd and looks away must not ask all of it.
TEST(Neighbours, AreTheSameFromTheEdgeLookingAway) {
  Random random(4);
  const Points points = spread(random, Spread::uniform, 3000, 10.0);
  const ProximityTree tree = tree_of(points);
  const Place place{{9.99, 5.0}, {1.0, 0.1}};
  const Near what{.most = 3, .view = {kSqrtHalf, kSqrtHalf}};
  EXPECT_EQ(near(tree, place, what), brute_force::near(points, place, what));
}

}  // namespace
}  // namespace throng::broadphase
