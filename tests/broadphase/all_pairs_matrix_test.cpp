// SPDX-License-Identifier: MIT
// All pairs against their definition, for every kind of cloud in every domain, with any number of threads and
// any width of vectors; and that neither changes their order.
#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <optional>

#include "broadphase/all_pairs.h"
#include "broadphase/brute_force.h"
#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

using Pairs = std::vector<Pair>;
using Box = Eigen::AlignedBox2d;

constexpr double kSide = 24.0;  // m

enum class Shape { uniform, clustered, line, slanted, lattice, one_cell, coincident };
constexpr Shape kShapes[] = {Shape::uniform, Shape::clustered, Shape::line,      Shape::slanted,
                             Shape::lattice, Shape::one_cell,  Shape::coincident};

Point point_of(Shape shape, Random& random, std::size_t row) {
  const Point p = random.in_square(kSide);
  switch (shape) {
    case Shape::uniform:
      return p;
    case Shape::clustered: {
      const Point centre = Point(3.0, 5.0) + static_cast<double>(row % 3) * Point(7.0, 6.0);
      return centre + Point(random.unit() * random.unit(), random.unit() * random.unit());
    }
    case Shape::line:
      return {p.x(), 7.0};
    case Shape::slanted:
      return {p.x(), 0.25 * p.x()};
    case Shape::lattice:
      return p.array().floor();
    case Shape::one_cell:
      return Point(5.0, 5.0) + 0.02 * p;
    case Shape::coincident:
      return {7.5, 3.25};
  }
  return p;
}

Points points_of(Shape shape, std::uint64_t seed, std::size_t n, const Point& offset) {
  Random random(seed);
  Points points;
  for (std::size_t row = 0; row < n; ++row) points.push_back(point_of(shape, random, row) + offset);
  return points;
}

/// As they were found, buffer after buffer.
Pairs in_order(const PairList& found) {
  Pairs pairs;
  found.for_each([&](const Pair& pair) { pairs.push_back(pair); });
  return pairs;
}

Pairs ascending(Pairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Calls `f(search)` with each width of vectors of this machine and 1 and 2 threads.
template <class F>
void for_each_way(const F& f) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (const int threads : {1, 2}) {
      SCOPED_TRACE(hwy::TargetName(target) + (", threads: " + std::to_string(threads)));
      AllPairs search(threads);
      f(search);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// What `find` puts into a list in each way: it must be the same.
template <class Find>
Pairs same_again(const Find& find) {
  std::optional<Pairs> first;
  for_each_way([&](AllPairs& search) {
    PairList found;
    find(search, found);
    if (!first) first = in_order(found);
    EXPECT_EQ(in_order(found), *first);
  });
  return ascending(*first);
}

class EveryCloud : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryCloud, ::testing::ValuesIn(kShapes));

TEST_P(EveryCloud, HasThePairsOfTheDefinitionInEveryDomain) {
  for (const double offset : {0.0, 1e9, -1e9})
    for (const double stray : {0.0, 1e6})
      for (const double reach : {0.0, 0.3, 1.0, 5.0}) {
        const std::uint64_t seed = 17;
        SCOPED_TRACE("seed " + std::to_string(seed) + ", offset " + std::to_string(offset));
        Points points = points_of(GetParam(), seed, 150, {offset, offset});
        const Period period{{offset, offset}, {kSide, kSide}};
        for (const Period* torus : {static_cast<const Period*>(nullptr), &period}) {
          if (torus && stray != 0.0) continue;
          if (stray != 0.0) points.push_back({offset + stray, offset});
          EXPECT_EQ(same_again(
                        [&](AllPairs& search, PairList& found) { search.find(points, reach, torus, found); }),
                    brute_force::pairs(points, reach, torus))
              << "stray " << stray << ", reach " << reach << ", periodic " << (torus != nullptr);
        }
      }
}

TEST_P(EveryCloud, HasThePairsOfTheDefinitionAsDiscsOfAllSizes) {
  for (const double offset : {0.0, 1e9})
    for (const double ratio : {1.0, 3.0, 50.0, 1000.0}) {
      const Points centres = points_of(GetParam(), 23, 150, {offset, -offset});
      Random random(5);
      std::vector<double> reach;
      for (std::size_t i = 0; i < centres.size(); ++i) reach.push_back(2.0 / random.between(1.0, ratio));
      const Period period{{offset, -offset}, {kSide, kSide}};
      for (const Period* torus : {static_cast<const Period*>(nullptr), &period})
        EXPECT_EQ(same_again([&](AllPairs& search, PairList& found) {
                    search.find_discs(centres, reach, torus, found);
                  }),
                  brute_force::pairs(centres, reach, torus))
            << "ratio " << ratio << ", periodic " << (torus != nullptr);
    }
}

// Ratios below 2 need one level, where each item looks all round; strays lie in strips that are hashed.
TEST_P(EveryCloud, HasThePairsOfTheDefinitionByRows) {
  for (const double offset : {0.0, 1e9})
    for (const double stray : {0.0, 1e6})
      for (const double ratio : {1.0, 1.9, 50.0})
        for (const double largest : {0.0, 0.15, 1.0}) {
          Points centres = points_of(GetParam(), 31, 150, {offset, -offset});
          Random random(9);
          std::vector<double> reach;
          for (std::size_t i = 0; i < 150; ++i) reach.push_back(largest / random.between(1.0, ratio));
          if (stray != 0.0) centres[70].x() += stray;
          const Period period{{offset, -offset}, {kSide, kSide}};
          for (const Period* torus : {static_cast<const Period*>(nullptr), &period}) {
            if (torus && stray != 0.0) continue;
            const Pairs expected = brute_force::pairs(centres, reach, torus);
            for_each_way([&](AllPairs& search) {
              HigherRows found;
              Pairs pairs{{7, 7}};
              search.find_discs(centres, reach, torus, found);
              found.write(pairs);
              EXPECT_EQ(pairs, expected)
                  << "seeds 31, 9, offset " << offset << ", stray " << stray << ", ratio " << ratio
                  << ", largest " << largest << ", periodic " << (torus != nullptr);
            });
          }
        }
}

TEST_P(EveryCloud, HasThePairsOfTheDefinitionAsBoxesOfAllSizes) {
  for (const double offset : {0.0, 1e9})
    for (const double ratio : {1.0, 3.0, 50.0, 1000.0}) {
      const Points corners = points_of(GetParam(), 29, 150, {offset, offset});
      Random random(6);
      std::vector<Box> boxes;
      for (const Point& corner : corners) {
        const double width = 3.0 / random.between(1.0, ratio), height = 3.0 / random.between(1.0, ratio);
        boxes.push_back(Box(corner, corner + Point(width, height)));
      }
      EXPECT_EQ(
          same_again([&](AllPairs& search, PairList& found) { search.find_boxes(boxes, found); }),
          brute_force::pairs(boxes.size(), [&](auto a, auto b) { return boxes[a].intersects(boxes[b]); }))
          << "ratio " << ratio;
    }
}

// Enough of them that threads share the sorting too.
TEST(AllPairsInThreads, HaveOneOrderForAnyNumber) {
  Random random(3);
  Points points;
  std::vector<double> reach;
  for (int i = 0; i < 60000; ++i) {
    points.push_back(random.in_square(200.0));
    reach.push_back(random.between(0.01, 0.6));
  }
  for (const double stray : {0.0, 1e9}) {
    if (stray != 0.0) points[77] = {stray, stray};
    const Pairs pairs =
        same_again([&](AllPairs& search, PairList& found) { search.find(points, 1.0, nullptr, found); });
    EXPECT_GT(pairs.size(), 100000u);
    EXPECT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end());
    const Pairs discs = same_again(
        [&](AllPairs& search, PairList& found) { search.find_discs(points, reach, nullptr, found); });
    EXPECT_GT(discs.size(), 40000u);
  }
}

// Beyond the table of targets that this machine has, the tests above prove nothing: there should be several.
TEST(AllPairsInVectors, AreTestedForSeveralWidths) {
  EXPECT_GE(hwy::SupportedAndGeneratedTargets().size(), 2u);
}

TEST(Boxes, TouchAtABorderAndACorner) {
  const std::vector<Box> boxes{Box(Point(0, 0), Point(1, 1)), Box(Point(1, 0), Point(2, 1)),
                               Box(Point(2, 1), Point(3, 2)),
                               Box(Point(std::nextafter(1.0, 2.0), 3), Point(5, 4))};
  PairList found;
  AllPairs().find_boxes(boxes, found);
  EXPECT_EQ(ascending(in_order(found)), (Pairs{{0, 1}, {1, 2}}));
}

TEST(Boxes, WithoutAWidthAreSegmentsAndPoints) {
  const std::vector<Box> boxes{Box(Point(0, 0), Point(4, 0)), Box(Point(2, -3), Point(2, 3)),
                               Box(Point(2, 0), Point(2, 0)), Box(Point(2, 1e-300), Point(2, 1e-300))};
  PairList found;
  AllPairs().find_boxes(boxes, found);
  EXPECT_EQ(ascending(in_order(found)), (Pairs{{0, 1}, {0, 2}, {1, 2}, {1, 3}}));
}

TEST(Boxes, AreFoundAmongNoneAndOne) {
  PairList found;
  AllPairs search;
  search.find_boxes({}, found);
  EXPECT_EQ(found.size(), 0u);
  search.find_boxes(std::vector<Box>{Box(Point(0, 0), Point(1, 1))}, found);
  EXPECT_EQ(found.size(), 0u);
}

}  // namespace
}  // namespace throng::broadphase
