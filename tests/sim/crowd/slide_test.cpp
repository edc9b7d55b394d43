// SPDX-License-Identifier: MIT
#include "sim/crowd/slide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace throng {
namespace {

Barriers of(std::vector<BarrierLine> lines) {
  return Barriers(lines, 1.0);
}

const BarrierLine kWall{{{0, 0}, {10, 0}}, false};

TEST(Slide, GoesOnWhereNothingIsInTheWay) {
  const Moved moved = slide(of({kWall}), {1, 2}, {3, -1}, 0.5);
  EXPECT_EQ(moved.to, Vec(4, 1));
  EXPECT_FALSE(moved.corrected);
}

TEST(Slide, StopsAtAWallThatIsMetHeadOn) {
  const Moved moved = slide(of({kWall}), {5, 2}, {0, -100}, 0.5);
  EXPECT_NEAR(moved.to.y(), 0.5, 1e-12);
  EXPECT_EQ(moved.to.x(), 5.0);
  EXPECT_TRUE(moved.corrected);
}

TEST(Slide, GoesOnAlongAWallThatIsMetAtAnAngle) {
  const Moved moved = slide(of({kWall}), {2, 1}, {3, -1}, 0.5);  // touches at (3.5, 0.5), half of the way
  EXPECT_NEAR(moved.to.x(), 5.0, 1e-12);
  EXPECT_NEAR(moved.to.y(), 0.5, 1e-12);
}

TEST(Slide, MeetsTheTipOfAWall) {
  const Moved moved = slide(of({kWall}), {-2, 0}, {1.8, 0}, 0.5);
  EXPECT_NEAR(moved.to.x(), -0.5, 1e-12);
  EXPECT_NEAR(moved.to.y(), 0.0, 1e-12);
}

TEST(Slide, GoesRoundTheTipOnItsFarSide) {
  const Moved moved = slide(of({kWall}), {-2, 0.3}, {1.8, 0}, 0.5);
  EXPECT_GT(moved.to.y(), 0.3);
  EXPECT_GE((moved.to - Vec(0, 0)).norm(), 0.5 - 1e-12);
}

// Rounding had him come nearer to the tip by 1e-17 of what was left to go along it, which stopped him again
// and again: who walked round the end of a wall stood there for ever.
TEST(Slide, GoesOnRoundTheTipFromWhereverHeTouchesIt) {
  const Barriers wall = of({{{{0, 5}, {4.5, 5}}, false}});
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 10'000; ++i) {
    const double radius = 0.1 + uniform(random), angle = 1.5 * uniform(random);
    const Vec out(std::cos(angle), -std::sin(angle)), along(-out.y(), out.x());
    const Vec from = slide(wall, Vec(4.5, 5.0) + (radius + 0.02) * out, -0.03 * out, radius).to;
    const Vec to = slide(wall, from, 0.03 * (along - 0.3 * out), radius).to;
    ASSERT_GT((to - from).dot(along), 0.025) << "radius " << radius << " angle " << angle;
  }
}

TEST(Slide, EndsInACorner) {
  const Barriers corner = of({{{{10, 0}, {0, 0}, {0, 10}}, false}});
  const Moved moved = slide(corner, {2, 3}, {-50, -60}, 0.5);
  EXPECT_NEAR((moved.to - Vec(0.5, 0.5)).norm(), 0.0, 1e-12);
}

TEST(Slide, EndsInAnAcuteCorner) {
  const Barriers corner = of({{{{10, 0}, {0, 0}, {10, 10}}, false}});
  const Moved moved =
      slide(corner, {5, 2}, {-50, -10}, 0.5);  // half way up it is 0.5 from y = 0 and from y = x
  EXPECT_NEAR((moved.to - Vec(0.5 + std::sqrt(0.5), 0.5)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(moved.corrected);
}

TEST(Slide, LetsWhoTouchesAWallLeaveIt) {
  const Moved moved = slide(of({kWall}), {5, 0.5}, {0.1, 0.2}, 0.5);
  EXPECT_EQ(moved.to, Vec(5.1, 0.7));
  EXPECT_FALSE(moved.corrected);
}

TEST(Slide, BringsWhoIsTooNearNoNearer) {
  const Moved moved = slide(of({kWall}), {5, 0.2}, {1.0, -1.0}, 0.5);
  EXPECT_NEAR(moved.to.y(), 0.2, 1e-12);
  EXPECT_NEAR(moved.to.x(), 6.0, 1e-12);
}

TEST(Slide, NeverLeavesAThornyCage) {
  const unsigned seed = 11;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double size : {1e-3, 1.0, 1e4}) {
    const Vec centre = size * Vec(300.0, -700.0);
    BarrierLine star{{}, true};
    for (int k = 0; k < 14; ++k) {
      const double angle = k * 2.0 * M_PI / 14, far = k % 2 ? 4.0 : 9.0;
      star.points.push_back(centre + size * far * Vec(std::cos(angle), std::sin(angle)));
    }
    const Region cage{{star.points}};
    const Barriers barriers({&star, 1}, size);
    const double radius = 0.3 * size;
    Vec p = centre;
    int corrected = 0, near = 0;
    for (int step = 0; step < 20'000; ++step) {
      const Moved moved =
          slide(barriers, p,
                size * std::pow(10.0, 2.0 * uniform(random)) * Vec(uniform(random), uniform(random)), radius);
      ASSERT_TRUE(contains(cage, moved.to)) << "seed " << seed << " size " << size << " step " << step;
      ASSERT_GE(barriers.distance(moved.to, radius), radius * (1.0 - 1e-8)) << "step " << step;
      near += barriers.distance(moved.to, 1.001 * radius) < 1.001 * radius;
      corrected += moved.corrected;
      p = moved.to;
    }
    EXPECT_GT(corrected, 5'000) << "it must have hit the cage";
    EXPECT_GT(near, 3'000);
  }
}

}  // namespace
}  // namespace throng
