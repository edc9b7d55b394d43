// SPDX-License-Identifier: MIT
#include "scenarios/wall_grid.h"

#include <gtest/gtest.h>

#include <set>

#include "scenarios/body_grid.h"
#include "sim/random.h"

namespace throng::scenarios {

namespace {

Vec random_point(Random& random, double size) {
  const double x = random.uniform(-size, size);
  const double y = random.uniform(-size, size);
  return {x, y};
}

}  // namespace

TEST(WallGrid, SeesExactlyThePiecesThatComeNear) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed, 0, 1, Purpose::place);
    Scene scene;
    for (int i = 0; i < 40; ++i) {
      const Vec a = random_point(random, 10.0);
      Vec b = a + random_point(random, i % 4 == 0 ? 20.0 : 1.0);
      if (i % 5 == 0) b.x() = a.x();
      if (i % 7 == 0) b.y() = a.y();
      scene.walls.push_back({{a, b}, false, 0});
    }
    const WallGrid grid(scene, 1.0);
    std::size_t hits = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec p = random_point(random, 12.0);
      std::set<std::uint32_t> seen, expected;
      grid.visit_near(p, 0.8, [&](const WallGrid::Piece& piece) { return seen.insert(piece.wall), false; });
      for (std::uint32_t wall = 0; wall < 40; ++wall)
        if (distance({scene.walls[wall].points[0], scene.walls[wall].points[1], wall}, p) < 0.8)
          expected.insert(wall);
      EXPECT_EQ(seen, expected);
      hits += expected.size();
    }
    EXPECT_GT(hits, 100u) << "too thin to have tested anything";
  }
}

TEST(BodyGrid, SeesExactlyTheBodiesThatComeNear) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed, 0, 2, Purpose::place);
    Domain domain;
    if (seed % 2 == 0) domain = {DomainKind::periodic, Vec(-10, -10), Vec(10, 10)};
    BodyGrid grid(domain, 3.0, 300);
    std::vector<std::pair<Vec, double>> bodies;
    for (std::uint32_t row = 0; row < 300; ++row) {
      const double radius = row % 50 == 0 ? 3.0 : random.uniform(0.01, 0.5);
      bodies.emplace_back(random_point(random, 10.0), radius);
      grid.add(row, bodies.back().first, radius);
    }
    std::size_t hits = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec p = random_point(random, 10.0);
      const double reach = i % 10 == 0 ? 3.0 : 0.3;
      std::multiset<std::uint32_t> seen, expected;
      grid.visit_near(p, reach,
                      [&](std::uint32_t row, const Vec&, double) { return seen.insert(row), false; });
      for (std::uint32_t row = 0; row < 300; ++row)
        for (int x = -1; x <= 1; ++x)
          for (int y = -1; y <= 1; ++y) {
            if (domain.kind != DomainKind::periodic && (x != 0 || y != 0)) continue;
            const double sum = reach + bodies[row].second;
            if ((bodies[row].first + Vec(20 * x, 20 * y) - p).squaredNorm() < sum * sum) expected.insert(row);
          }
      EXPECT_EQ(seen, expected);
      hits += expected.size();
    }
    EXPECT_GT(hits, 200u) << "too thin to have tested anything";
  }
}

}  // namespace throng::scenarios
