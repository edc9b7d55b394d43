// SPDX-License-Identifier: MIT
// Every way to ask for neighbours against the definition: over clouds, domains, offsets, threads and SIMD.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <rapidcheck/gtest.h>
#include <limits>

#include "broadphase/brute_force.h"
#include "tests/broadphase/clouds.h"
#include "tests/broadphase/least_seconds.h"
#include "tests/broadphase/list.h"

namespace throng::broadphase {
namespace {

using Neighbours = std::vector<Neighbour>;
using Kind = ProximityTree::Kind;

/// A tree, and all that its definition takes.
struct Sample {
  Kind kind = Kind::points;
  std::optional<Period> period;
  Points points;
  std::vector<double> radius;
  std::vector<Box> boxes;
  std::vector<std::uint32_t> groups;
  ProximityTree tree;

  const Period* where() const { return period ? &*period : nullptr; }

  void build() {
    if (kind == Kind::points) tree.build(points, where(), groups);
    if (kind == Kind::discs) tree.build(points, radius, where(), groups);
    if (kind == Kind::boxes) tree.build(boxes, groups);
  }
  Neighbours near(const Place& place, const Near& what) const {
    if (kind == Kind::points) return brute_force::near(points, place, what, where(), groups);
    if (kind == Kind::discs) return brute_force::near(points, radius, place, what, where(), groups);
    return brute_force::near(boxes, place, what, groups);
  }
};

/// Things of sizes up to `side` / 4 in [origin, origin + side].
Sample sample(Random& random, Kind kind, Spread how, std::size_t n, const Point& origin, double side,
              bool periodic, bool grouped) {
  Sample s;
  s.kind = kind;
  if (periodic) s.period = {origin, Point(side, side)};
  s.points = moved(spread(random, how, n, side), origin);
  if (periodic)
    for (Point& p : s.points) p = p.cwiseMin(s.period->origin + s.period->size);
  for (std::size_t row = 0; row < n; ++row) {
    s.radius.push_back(row % 5 ? random.between(0.0, 0.05 * side) : row % 2 ? 0.0 : 0.25 * side);
    const Point size = s.radius[row] * random.in_square(1.0);
    s.boxes.push_back({s.points[row], s.points[row] + size});
    if (grouped) s.groups.push_back(1U << random.below(4));
  }
  s.build();
  return s;
}

Neighbours sorted_calls(const ProximityTree& tree, const Place& place, const Near& near) {
  Neighbours result;
  for_each_near(tree, place, near, [&](std::uint32_t row, double d) { result.push_back({row, d}); });
  std::sort(result.begin(), result.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.row < b.row;
  });
  return result;
}

Near question(Random& random, std::size_t n, double side) {
  constexpr double kFar[] = {0.0, 0.02, 0.1, 0.4, 0.7, std::numeric_limits<double>::infinity()};
  const double turn = random.between(0.01, 3.14);
  Near near;
  near.radius = kFar[random.below(6)] * side;
  if (near.radius != near.radius) near.radius = 0.0;
  if (random.below(3)) near.most = random.below(4) ? 1 + random.below(12) : 1 + random.below(n + 50);
  if (random.below(2)) near.groups = static_cast<std::uint32_t>(1 + random.below(15));
  if (random.below(2)) near.view = {std::cos(turn), std::sin(turn)};
  return near;
}

/// Asks everything in every way about a sample; returns how much of it was found.
double expect_definition(Random& random, const Sample& s, const Point& origin, double side) {
  const std::size_t n = s.points.size();
  Near near = question(random, n, side);
  Points at = s.points, heading;
  std::vector<double> radius;
  for (std::size_t i = 0; i < n; ++i) {
    heading.push_back(random.below(9) ? Point(random.in_square(2.0) - Point(1, 1)) : Point(0, 0));
    radius.push_back(std::min(near.radius * random.between(0.5, 1.5), 1e9 * side));
  }
  const bool own = random.below(3) > 0;
  if (!own)
    for (Point& p : at) p = origin + random.in_square(side);
  const bool each = random.below(2) > 0;
  const std::size_t first = own ? random.below(n) : 0, count = n - first;
  const Places places{std::span(at).subspan(first), std::span(heading).subspan(first),
                      each ? std::span<const double>(radius).subspan(first) : std::span<const double>(),
                      own ? std::optional(static_cast<std::uint32_t>(first)) : std::nullopt};
  NeighbourSearch search;
  NeighbourLists lists, again;
  search.find(s.tree, places, near, lists);
  search.find(s.tree, places, near, again, 2);
  EXPECT_EQ(lists.begin, again.begin);
  EXPECT_EQ(lists.row, again.row);
  EXPECT_EQ(lists.distance, again.distance);
  double found = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (each) near.radius = places.radius[i];
    const Place place{places.at[i], places.heading[i],
                      own ? std::optional(static_cast<std::uint32_t>(first + i)) : std::nullopt};
    const Neighbours expected = s.near(place, near);
    found += static_cast<double>(expected.size()) / static_cast<double>(count * n);
    EXPECT_EQ(list(lists, i), expected);
    if (i % 16) continue;
    Neighbours one;
    find_near(s.tree, place, near, one);
    EXPECT_EQ(one, expected);
    Near all = near;
    all.most = std::numeric_limits<std::size_t>::max();
    EXPECT_EQ(sorted_calls(s.tree, place, all), s.near(place, all));
  }
  return found;
}

class EveryTarget : public testing::TestWithParam<std::int64_t> {
 protected:
  EveryTarget() { hwy::SetSupportedTargetsForTest(GetParam()); }
  ~EveryTarget() override { hwy::SetSupportedTargetsForTest(0); }
};

INSTANTIATE_TEST_SUITE_P(Neighbours, EveryTarget, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

TEST_P(EveryTarget, AgreesWithTheDefinition) {
  const std::uint64_t seed = 7;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  double found = 0.0, asked = 0.0;
  for (const Kind kind : {Kind::points, Kind::discs, Kind::boxes})
    for (const Spread how : kSpreads)
      for (const bool periodic : {false, true})
        for (const double offset : {0.0, 1e9, -1e9})
          for (const std::size_t n : {1, 7, 9, 70, 700}) {
            if (periodic && kind == Kind::boxes) continue;
            SCOPED_TRACE(testing::Message()
                         << "kind " << static_cast<int>(kind) << ", spread " << static_cast<int>(how)
                         << ", periodic " << periodic << ", offset " << offset << ", n " << n);
            const Point origin(offset, -0.5 * offset);
            const Sample s = sample(random, kind, how, n, origin, 16.0, periodic, random.below(2) > 0);
            found += expect_definition(random, s, origin, 16.0);
            asked += 1.0;
            if (HasFailure()) return;
          }
  EXPECT_GT(found / asked, 0.05);
  EXPECT_LT(found / asked, 0.6);
}

TEST(NeighbourSearch, AnswersNothingToNobody) {
  ProximityTree tree;
  tree.build(Points{});
  NeighbourSearch search;
  NeighbourLists lists;
  search.find(tree, {}, {}, lists);
  EXPECT_EQ(lists.size(), 0u);
  const Points at{{1, 2}, {3, 4}};
  search.find(tree, {.at = at}, {.most = 3}, lists);
  EXPECT_EQ(lists.begin, (std::vector<std::size_t>{0, 0, 0}));
  tree.build(at);
  search.find(tree, {.at = at}, {.most = 0}, lists);
  EXPECT_EQ(lists.row.size(), 0u);
  search.find(tree, {.at = at, .own = 0}, {.most = 9}, lists);
  EXPECT_EQ(lists.row, (std::vector<std::uint32_t>{1, 0}));
}

/// What stands behind the last answer was once written beyond the memory that had been taken for them: seen
/// with the address sanitizer.
TEST(NeighbourSearch, HasRoomForAnyNumberOfAnswers) {
  Random random{20261121};
  for (std::size_t n = 1; n <= 800; ++n) {
    Sample s = sample(random, Kind::points, Spread::uniform, n, Point(0.0, 0.0), 1.0, false, false);
    for (const double radius : {0.3, 0.5}) {  // leaves are met in part, so that any number is reached
      NeighbourSearch search;
      NeighbourLists lists;
      const Point at(0.5, 0.5);
      search.find(s.tree, {.at = {&at, 1}}, {.radius = radius}, lists);
      const Neighbours expected = s.near({at}, {.radius = radius});
      ASSERT_EQ(lists.row.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(lists.row[i], expected[i].row) << n;
    }
  }
}

TEST(NeighbourSearch, GivesThePermutedRowsOfPermutedPoints) {
  Random random(11);
  const Points points = cloud(random, 600, 20.0);
  std::vector<std::uint32_t> from(points.size());
  for (std::uint32_t i = 0; i < from.size(); ++i) from[i] = i;
  random.shuffle(from);
  Points permuted;
  for (const std::uint32_t row : from) permuted.push_back(points[row]);
  ProximityTree a, b;
  a.build(points);
  b.build(permuted);
  NeighbourSearch search;
  NeighbourLists straight, turned;
  search.find(a, {.at = points, .own = 0}, {.radius = 2.0}, straight);
  search.find(b, {.at = permuted, .own = 0}, {.radius = 2.0}, turned);
  for (std::size_t i = 0; i < from.size(); ++i) {
    Neighbours expected = list(straight, from[i]), renamed = list(turned, i);
    for (Neighbour& n : renamed) n.row = from[n.row];
    const auto less = [](const Neighbour& p, const Neighbour& q) {
      return p.distance != q.distance ? p.distance < q.distance : p.row < q.row;
    };
    std::sort(renamed.begin(), renamed.end(), less);  // ties go by the new rows
    EXPECT_EQ(renamed, expected);
  }
}

// Each once met all that is as near as its last answer, though only those of lower rows could be among the
// nearest: of n points in one place n² in all, of which every question kept n.
TEST(NeighbourSearch, FindsTheFewNearestOfManyInOnePlace) {
  constexpr std::size_t kMany = 20000;
  Random random(8);
  Points points(kMany, Point(3.0, 4.0));
  for (std::size_t row = 0; row < kMany; row += 3) points[row] = {5.0, 6.0};  // two heaps, rows mixed
  const std::vector<Box> boxes(kMany, Box(Point(0, 0), Point(9, 9)));
  ProximityTree tree, boxed, even;
  tree.build(points);
  boxed.build(boxes);
  even.build(spread(random, Spread::uniform, kMany, 100.0));
  NeighbourSearch search;
  NeighbourLists lists;
  for (const std::size_t most : {std::size_t{3}, std::size_t{100}}) {
    const double usual = least_seconds([&] { search.find(even, {.at = points}, {.most = most}, lists); });
    const auto expect_few = [&](const ProximityTree& heaps, const auto& things) {
      EXPECT_LT(least_seconds([&] { search.find(heaps, {.at = points, .own = 0}, {.most = most}, lists); }),
                30.0 * usual + 0.1);
      for (const std::uint32_t row : {0U, 1U, 777U, 19999U})
        EXPECT_EQ(list(lists, row),
                  brute_force::near(things, Place{points[row], {0, 0}, row}, Near{.most = most}));
    };
    expect_few(tree, std::span<const Point>(points));
    expect_few(boxed, std::span<const Box>(boxes));
    std::vector<Neighbour> one;
    EXPECT_LT(least_seconds([&] {
                for (const Point& p : points) find_near(tree, {p}, {.most = most}, one);
              }),
              30.0 * usual + 0.1);
  }
}

RC_GTEST_PROP(NeighbourSearch, AgreesWithTheDefinitionOnWholeNumbers, ()) {
  // Small whole coordinates: ties, coincidences and borders abound.
  const auto xs = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-4, 5));
  const auto ys = *rc::gen::container<std::vector<int>>(xs.size(), rc::gen::inRange(-4, 5));
  Points points;
  for (std::size_t i = 0; i < xs.size(); ++i) points.push_back({xs[i], ys[i]});
  const Near near{.radius = static_cast<double>(*rc::gen::inRange(0, 7)),
                  .most = static_cast<std::size_t>(*rc::gen::inRange(1, 30))};
  ProximityTree tree;
  tree.build(points);
  NeighbourSearch search;
  NeighbourLists lists;
  search.find(tree, {.at = points, .own = 0}, near, lists);
  for (std::uint32_t row = 0; row < points.size(); ++row)
    RC_ASSERT(list(lists, row) == brute_force::near(points, Place{points[row], {0, 0}, row}, near));
}

}  // namespace
}  // namespace throng::broadphase
