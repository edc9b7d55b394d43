// SPDX-License-Identifier: MIT
#include "sim/crowd/clearance.h"

#include <gtest/gtest.h>

#include <random>

#include "sim/crowd/barriers.h"

namespace throng {
namespace {

struct World {
  explicit World(std::vector<std::vector<Vec>> lines) {
    std::vector<broadphase::Extent> extents;
    for (const auto& line : lines)
      for (std::size_t i = 1; i < line.size(); ++i) {
        segments.push_back({line[i - 1], line[i]});
        extents.push_back(broadphase::Extent::of_segment(line[i - 1], line[i]));
        bounds.extend(line[i - 1]), bounds.extend(line[i]);
      }
    index.build(extents, 1.0);
  }
  double distance(const Vec& p) const {
    double least = 1e300;
    for (const auto& [a, b] : segments) least = std::min(least, (nearest_on_segment(a, b, p) - p).norm());
    return least;
  }

  std::vector<std::pair<Vec, Vec>> segments;
  broadphase::BoxIndex index;
  Eigen::AlignedBox2d bounds;
};

TEST(Clearance, IsNeverMoreThanTheDistanceAndSeldomMuchLess) {
  std::mt19937_64 random(3);
  const auto uniform = [&](double high) { return high * (static_cast<double>(random() >> 11) * 0x1p-53); };
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::vector<Vec>> lines{{{0, 0}, {40, 0}, {40, 30}, {0, 30}, {0, 0}}};
    for (int i = 0; i < 4; ++i) {
      const double x = uniform(40), y = uniform(30), dx = uniform(6), dy = uniform(6);
      lines.push_back({{x, y}, {x + dx - 3, y + dy - 3}});
    }
    const World world(lines);
    const Clearance clearance(world.index, world.bounds, 0.5);
    double lost = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const double x = uniform(40);
      const Vec p(x, uniform(30));
      const double truth = world.distance(p), least = clearance.at(p);
      ASSERT_LE(least, truth) << "seed 3, trial " << trial;
      ASSERT_GE(least, 0.0);
      lost += truth - least;
    }
    EXPECT_LT(lost / 1000, 3.0) << "m: a cell or two, and what diagonals lose";
  }
}

TEST(Clearance, IsNothingOutsideItsBoundsAndInNothing) {
  const World world({{{0, 0}, {9, 0}, {9, 9}}});
  const Clearance clearance(world.index, world.bounds, 1.0);
  EXPECT_GT(clearance.at({2, 7}), 1.0);
  for (const Vec& p : {Vec(-1, 5), Vec(5, -1), Vec(11, 5), Vec(5, 11), Vec(1e300, 0), Vec(0, -1e300)})
    EXPECT_EQ(clearance.at(p), 0.0);
  EXPECT_EQ(Clearance().at({0, 0}), 0.0);
}

TEST(Clearance, BearsWallsThatAreHugeTinyAndInOnePlace) {
  for (const double size : {1e-6, 1.0, 1e9}) {
    const World world({{{0, 0}, {size, 0}}, {{0, 5 * size}, {0, 5 * size}}});
    const Clearance clearance(world.index, world.bounds, 1e-3);
    for (double at = 0.0; at <= 1.0; at += 0.125)
      EXPECT_LE(clearance.at({0.5 * size, at * 5 * size}), world.distance({0.5 * size, at * 5 * size}));
  }
}

TEST(Barriers, AreClearAsFarAsNoneStandsOrMoves) {
  Barriers barriers(std::vector<BarrierLine>{{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, true}}, 0.5);
  EXPECT_GT(barriers.clear({10, 10}), 7.0);
  EXPECT_LE(barriers.clear({10, 10}), 10.0);
  barriers.set_moving(std::vector<BarrierLine>{{{{12, 9}, {14, 11}}, false}, {{{5, 5}, {6, 5}}, false}});
  EXPECT_EQ(barriers.clear({10, 10}), 2.0) << "to the box of the one that is nearer";
  EXPECT_EQ(barriers.clear({13, 10}), 0.0);
}

}  // namespace
}  // namespace throng
