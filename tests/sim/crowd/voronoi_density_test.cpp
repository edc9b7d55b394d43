// SPDX-License-Identifier: MIT
#include "sim/crowd/voronoi_density.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/random.h"
#include "tests/sim/crowd/box.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

TEST(VoronoiDensity, OfOneAgentIsThatOfItsArea) {
  VoronoiDensity one(box(0, 0, 10, 10), box(3, 3, 7, 7), 16.0, 1.0);
  const std::vector<Vec> middle{{5, 5}}, edge{{3, 5}}, outside{{2.5, 5}}, far{{1.5, 1.5}};
  EXPECT_NEAR(one.density(middle), 1.0 / 16.0, 1e-12) << "its disc is in it";
  EXPECT_NEAR(one.density(edge), 0.5 / 16.0, 1e-12);
  EXPECT_GT(one.density(outside), 0.0);
  EXPECT_LT(one.density(outside), 0.5 / 16.0);
  EXPECT_EQ(one.density(far), 0.0);
  EXPECT_EQ(one.density({}), 0.0);
}

TEST(VoronoiDensity, OfALatticeIsThatOfTheLattice) {
  std::vector<Vec> lattice;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k) lattice.push_back({0.25 + 0.5 * i, 0.25 + 0.5 * k});
  for (const double x : {4.0, 4.1, 4.3}) {  // wherever the area's edges cut cells
    VoronoiDensity all(box(0, 0, 10, 10), box(x, 4, x + 1, 5), 1.0, 2.0);
    EXPECT_NEAR(all.density(lattice), 4.0, 1e-9);
  }
}

TEST(VoronoiDensity, OfCellsThatEndAtTheFloor) {
  // two agents on 2 m x 1 m of floor: a cell of 1 m² each, whatever lies outside
  VoronoiDensity two(box(0, 0, 2, 1), box(0, 0, 1, 1), 1.0, 5.0);
  EXPECT_NEAR(two.density(std::vector<Vec>{{0.5, 0.5}, {1.5, 0.5}}), 1.0, 1e-12);
  EXPECT_NEAR(two.density(std::vector<Vec>{{0.4, 0.5}, {1.2, 0.5}}), 1.0 + 0.2 / 1.2, 1e-12)
      << "cells of 0.8 and 1.2 m²";
  EXPECT_NEAR(two.density(std::vector<Vec>{{0.5, 0.5}, {0.5, 0.5}}), 1.0, 1e-12) << "both have all of it";
}

// Agents in the next room gave part of their cells to this one's density, through the wall.
TEST(VoronoiDensity, EndsAtWallsOfTwoSides) {
  const Region rooms{{{{0, 0}, {4, 0}, {4, 1}, {0, 1}}, {{1.9, 0}, {2.1, 0}, {2.1, 1}, {1.9, 1}}}};
  VoronoiDensity left(rooms, box(0, 0, 1.9, 1), 1.9, 5.0);
  EXPECT_NEAR(left.density(std::vector<Vec>{{1.0, 0.5}, {2.2, 0.5}}), 1.0 / 1.9, 1e-9)
      << "whose cell goes up to x = 1.6, as far as the other's, who has nothing of this room";
  EXPECT_NEAR(left.density(std::vector<Vec>{{1.0, 0.5}}), 1.0 / 1.9, 1e-9);
  EXPECT_NEAR(left.density(std::vector<Vec>{{2.2, 0.5}}), 0.0, 1e-12);
}

TEST(VoronoiDensity, AgreesWithTheNearestAgentOfEachOfManyPoints) {
  const Region floor{{{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{2, 2}, {3, 2}, {3, 3}, {2, 3}}}};
  const Region area{{{{1, 1}, {5, 1}, {5, 4}, {1, 4}}, {{2, 2}, {3, 2}, {3, 3}, {2, 3}}}};
  const double size = 11.0, cutoff = 0.9;
  Random random(4, 0, 1, Purpose::place);
  std::vector<Vec> agents;
  while (agents.size() < 30) {
    const double x = random.uniform(0, 6);
    const Vec p(x, random.uniform(0, 6));
    if (contains(floor, p)) agents.push_back(p);
  }
  double xs[30], ys[30];
  for (std::size_t a = 0; a < 30; ++a) xs[a] = agents[a].x(), ys[a] = agents[a].y();
  std::vector<double> whole(30, 0.0), part(30, 0.0);
  const int n = 1500;
  for (int i = 0; i < n * n; ++i) {
    const Vec p(6.0 * (i % n + 0.5) / n, 6.0 * (i / n + 0.5) / n);
    if (!contains(floor, p)) continue;
    const double x = p.x(), y = p.y();
    std::size_t nearest = 30;
    double least = cutoff * cutoff;
    for (std::size_t a = 0; a < 30; ++a) {  // plain numbers: the sanitizers watch each
      const double dx = x - xs[a], dy = y - ys[a], d = dx * dx + dy * dy;
      if (d <= least) nearest = a, least = d;
    }
    if (nearest == 30) continue;
    whole[nearest] += 1.0, part[nearest] += contains(area, p);
  }
  double sum = 0.0;
  for (std::size_t a = 0; a < 30; ++a) sum += part[a] / whole[a];
  EXPECT_GT(sum, 10.0);
  EXPECT_NEAR(VoronoiDensity(floor, area, size, cutoff).density(agents), sum / size, 2e-3);
}

TEST(VoronoiDensity, KnowsNoCutOffInADenseCrowd) {
  Random random(7, 0, 0, Purpose::place);
  std::vector<Vec> agents;
  for (int i = 0; i < 900; ++i) {
    const double x = 0.3 * (i % 30) + random.uniform(0, 0.25);
    agents.emplace_back(x, 0.3 * (i / 30) + random.uniform(0, 0.25));
  }
  const Region floor = box(0, 0, 9, 9), area = box(3, 3, 6, 6);
  const double density = VoronoiDensity(floor, area, 9.0, 5.0).density(agents);
  EXPECT_NEAR(density, 1.0 / 0.09, 0.3);
  for (const double cutoff : {0.45, 0.7, 1.0, 2.0})
    EXPECT_NEAR(VoronoiDensity(floor, area, 9.0, cutoff).density(agents), density, 1e-9) << cutoff;
}

TEST(VoronoiDensity, IsMeasuredInAnArea) {
  Trial run(
      "walkable = 'POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0))'\nareas.exit = [[8, 8], [9, 8], [9, 9]]\n"
      "areas.middle = [[3, 3], [6, 3], [6, 6], [3, 6]]\n"
      "[[measure]]\nname = 'm'\narea = 'middle'\nvoronoi = { cutoff = 0.5 }\n"
      "[[measure]]\nname = 'plain'\narea = 'middle'\n"
      "[[agents]]\nmodel = 'constant_velocity'\ngoal = 'exit'\ndesired_speed = 0\nat = [4, 4]\n");
  run.steps(10);
  const Reading with = reading(run.scene.crowd.measures[0], run.state.crowd.measured[0], 0.01);
  const Reading without = reading(run.scene.crowd.measures[1], run.state.crowd.measured[1], 0.01);
  ASSERT_TRUE(with.density_voronoi && !without.density_voronoi);
  EXPECT_NEAR(*with.density_voronoi, 1.0 / 9.0, 1e-12);
}

}  // namespace
}  // namespace throng
