// SPDX-License-Identifier: MIT
#include "sim/sensing/sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

#include "tests/less_when_watched.h"

namespace throng {
namespace {

Sight sight_of(const std::vector<Vec>& points, bool closed = false, double distance = 1.0) {
  return {std::vector<Wall>{{points, closed}}, {}, distance};
}

TEST(Sight, EndsAtAWall) {
  const Sight sight = sight_of({{0, -1}, {0, 1}});
  EXPECT_FALSE(sight.sees({-1, 0}, {1, 0}));
  EXPECT_TRUE(sight.sees({-1, 0}, {-0.001, 0}));
  EXPECT_TRUE(sight.sees({-1, 2}, {1, 2}));
  EXPECT_TRUE(sight.sees({-1, 2}, {1, 1}));
  EXPECT_TRUE(Sight({}, {}, 1.0).sees({-1, 0}, {1, 0}));
}

TEST(Sight, EndsWhereItTouchesAWall) {
  const Sight sight = sight_of({{0, -1}, {0, 1}});
  EXPECT_FALSE(sight.sees({-1, 2}, {1, 0}));         // the wall's end, by the way
  EXPECT_FALSE(sight.sees({-1, 0}, {0, 0}));         // who stands on the wall is hidden
  EXPECT_FALSE(sight.sees({0, 2}, {0, 1.5 - 0.5}));  // along the wall up to it
  EXPECT_FALSE(sight.sees({0, 3}, {0, -3}));
  EXPECT_TRUE(sight.sees({0, 3}, {0, 1.0000000000000002}));
}

TEST(Sight, DoesNotPassWhereWallsMeet) {
  const Sight sight = sight_of({{0, -1}, {0.1, 0.3}, {0, 1}});
  EXPECT_FALSE(sight.sees({-1, 0.3}, {1, 0.3}));
  EXPECT_FALSE(sight_of({{0, 0}, {1, 0}, {1, 1}}, true).sees({0.4, 0.6}, {0.6, 0.4}));  // the closing side
}

TEST(Sight, GoesThroughAGapOfOneBit) {
  const double end = std::nextafter(1.0, 2.0);
  const std::vector<Wall> walls{{{{0, -9}, {0, 1}}}, {{{0, std::nextafter(end, 2.0)}, {0, 9}}}};
  const Sight sight(walls, {}, 30.0);
  EXPECT_TRUE(sight.sees({-1, end}, {1, end}));
  EXPECT_FALSE(sight.sees({-1, 1}, {1, 1}));
}

TEST(Sight, TakesTheNearestImage) {
  const broadphase::Period period{{0, 0}, {10, 10}};
  const Sight sight(std::vector<Wall>{{{{9.5, 4}, {9.5, 6}}}, {{{5, 0}, {5, 3}}}}, period, 1.0);
  EXPECT_FALSE(sight.sees({9, 5}, {1, 5}));  // round the seam, through the first wall
  EXPECT_FALSE(sight.sees({1, 5}, {9, 5}));  // and its image
  EXPECT_TRUE(sight.sees({9, 1}, {1, 1}));   // away from the second
  EXPECT_FALSE(sight.sees({4, 1}, {6, 9}));  // down round the seam, at y = 0
}

std::int64_t side(const Vec& a, const Vec& b, const Vec& c) {  // of whole numbers: exact
  const double d = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  return d > 0.0 ? 1 : d < 0.0 ? -1 : 0;
}
bool meet(const Vec& p, const Vec& q, const Vec& r, const Vec& s) {
  for (const int axis : {0, 1})
    if (std::max(p[axis], q[axis]) < std::min(r[axis], s[axis]) ||
        std::max(r[axis], s[axis]) < std::min(p[axis], q[axis]))
      return false;
  return side(p, q, r) * side(p, q, s) <= 0 && side(r, s, p) * side(r, s, q) <= 0;
}

TEST(Sight, AgreesWithTheDefinitionOnWholeNumbers) {
  const std::uint64_t seed = 20261121;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto below = [&](std::uint64_t n) { return static_cast<double>(random() % n); };
  std::size_t seen = 0, asked = 0;
  for (std::size_t round = 0; round < less_when_watched(400); ++round) {
    const bool far = round % 2;
    const double span = round % 3 ? 12.0 : 4000.0;
    const auto place = [&]() -> Vec {
      return Vec(below(static_cast<std::uint64_t>(span)), below(static_cast<std::uint64_t>(span)));
    };
    std::vector<Wall> walls;
    for (std::uint64_t i = 0; i < 1 + random() % 40; ++i) {
      const Vec a = place();
      const Vec b = span > 12.0 && i % 4 ? Vec(a + Vec(below(40), below(40))) : place();
      if (a != b) walls.push_back({{a, b}, false});
    }
    const Sight sight(walls, {}, far ? span : 1.0);
    for (int i = 0; i < 50; ++i) {
      const Vec p = place(), q = place();
      const bool blocked = std::ranges::any_of(
          walls, [&](const Wall& wall) { return meet(p, q, wall.points[0], wall.points[1]); });
      EXPECT_EQ(sight.sees(p, q), !blocked) << p.transpose() << " to " << q.transpose();
      EXPECT_EQ(sight.sees(q, p), !blocked);
      seen += !blocked;
      ++asked;
    }
  }
  EXPECT_GT(seen, asked / 5);
  EXPECT_LT(seen, asked * 4 / 5);
}

}  // namespace
}  // namespace throng
