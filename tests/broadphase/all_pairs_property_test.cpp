// SPDX-License-Identifier: MIT
// Laws of all pairs for clouds that RapidCheck draws and makes smaller; a failure prints the seed that
// repeats it.
#include <gtest/gtest.h>

#include <rapidcheck.h>

#include "broadphase/all_pairs.h"
#include "broadphase/brute_force.h"

namespace throng::broadphase {
namespace {

using Pairs = std::vector<Pair>;

Pairs ascending(const PairList& found) {
  Pairs pairs;
  HigherRows higher;
  higher.assign(found, 1000);
  higher.write(pairs);
  return pairs;
}

Pairs all_pairs(const std::vector<Point>& points, double reach) {
  PairList found;
  AllPairs().find(points, reach, nullptr, found);
  return ascending(found);
}

/// Coordinates in steps of an eighth, so that many lie on borders of cells and at the reach exactly.
rc::Gen<std::vector<Point>> clouds() {
  const auto coordinate = rc::gen::map(rc::gen::inRange(-200, 200), [](int i) { return 0.125 * i; });
  return rc::gen::container<std::vector<Point>>(
      rc::gen::map(rc::gen::pair(coordinate, coordinate), [](auto p) { return Point(p.first, p.second); }));
}

rc::Gen<double> reaches() {
  return rc::gen::map(rc::gen::inRange(0, 80), [](int i) { return 0.125 * i; });
}

TEST(AllPairsOfAnyCloud, AreThoseOfTheDefinition) {
  EXPECT_TRUE(rc::check([] {
    const auto points = *clouds();
    const double reach = *reaches();
    RC_ASSERT(all_pairs(points, reach) == brute_force::pairs(points, reach));
  }));
}

TEST(AllPairsOfAnyCloud, DontChangeWhereItMovesOrIsTurnedByAQuarter) {
  EXPECT_TRUE(rc::check([] {
    const auto points = *clouds();
    const double reach = *reaches();
    std::vector<Point> moved, turned;
    for (const Point& p : points) {
      moved.push_back(p + Point(1048576.0, -4096.0));
      turned.push_back({-p.y(), p.x()});
    }
    const Pairs pairs = all_pairs(points, reach);
    RC_ASSERT(all_pairs(moved, reach) == pairs);
    RC_ASSERT(all_pairs(turned, reach) == pairs);
  }));
}

TEST(AllPairsOfAnyCloud, GrowWithTheReach) {
  EXPECT_TRUE(rc::check([] {
    const auto points = *clouds();
    const double reach = *reaches();
    const Pairs few = all_pairs(points, reach), many = all_pairs(points, reach + 0.5);
    RC_ASSERT(std::includes(many.begin(), many.end(), few.begin(), few.end()));
  }));
}

TEST(AllPairsOfAnyCloud, AreThoseOfDiscsOfHalfTheReachAndOfBoxesBetween) {
  EXPECT_TRUE(rc::check([] {
    const auto points = *clouds();
    const double half = 0.5 * *reaches();
    std::vector<Eigen::AlignedBox2d> boxes;
    for (const Point& p : points) boxes.push_back({p - Point(half, half), p + Point(half, half)});
    PairList discs, squares;
    AllPairs().find_discs(points, std::vector<double>(points.size(), half), nullptr, discs);
    AllPairs().find_boxes(boxes, squares);
    const Pairs touching = ascending(discs), boxed = ascending(squares);
    RC_ASSERT(touching == all_pairs(points, 2.0 * half));
    RC_ASSERT(std::includes(boxed.begin(), boxed.end(), touching.begin(), touching.end()));
  }));
}

}  // namespace
}  // namespace throng::broadphase
