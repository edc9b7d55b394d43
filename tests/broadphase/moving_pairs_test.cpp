// SPDX-License-Identifier: MIT
#include "broadphase/moving_pairs.h"

#include <gtest/gtest.h>

#include "broadphase/brute_force.h"
#include "tests/broadphase/clouds.h"

namespace throng::broadphase {
namespace {

using Pairs = std::vector<Pair>;

/// Discs that move, grow and shrink a little each step, in a square or on a torus.
class Dance {
 public:
  Dance(std::uint64_t seed, std::size_t n, double side, double step, bool periodic)
      : random_(seed), side_(side), step_(step), torus_{{0, 0}, {side, side}}, periodic_(periodic) {
    for (std::size_t i = 0; i < n; ++i) {
      centres.push_back(random_.in_square(side));
      reach.push_back(random_.between(0.1, 0.5));
    }
  }

  void step() {
    for (std::size_t i = 0; i < centres.size(); ++i) {
      centres[i] += Point(random_.between(-step_, step_), random_.between(-step_, step_));
      reach[i] = std::abs(reach[i] + random_.between(-0.1, 0.1) * step_);
      if (periodic_) centres[i] = inside(centres[i]);
    }
  }

  const Period* period() const { return periodic_ ? &torus_ : nullptr; }

  std::vector<Point> centres;
  std::vector<double> reach;

 private:
  Point inside(Point p) const {
    for (int axis = 0; axis < 2; ++axis) {
      if (p[axis] < 0.0) p[axis] = std::min(p[axis] + side_, side_);
      if (p[axis] > side_) p[axis] -= side_;
    }
    return p;
  }

  Random random_;
  double side_, step_;
  Period torus_;
  bool periodic_;
};

TEST(MovingPairs, AreThoseOfTheDefinitionAtEveryStep) {
  for (const double step : {0.0, 1e-9, 1e-3, 1e-2, 0.05, 0.5})
    for (const bool periodic : {false, true}) {
      Dance dance(101, 200, 9.0, step, periodic);
      Team alone(1);
      MovingPairs moving(alone);
      Pairs pairs;
      int reused = 0;
      for (int i = 0; i < 60; ++i) {
        moving.find(dance.centres, dance.reach, dance.period(), pairs);
        reused += moving.reused();
        ASSERT_EQ(pairs, brute_force::pairs(dance.centres, dance.reach, dance.period()))
            << "seed 101, step " << step << ", " << i;
        dance.step();
      }
      EXPECT_GE(reused, step <= 1e-3 ? 50 : 0) << step;
      EXPECT_LE(reused, step >= 0.5 ? 0 : 60) << step;  // and goes without
    }
}

TEST(MovingPairs, AreTheSameForAnyNumberOfThreads) {
  for (const bool periodic : {false, true}) {
    Dance dance(102, 5000, 60.0, 1e-2, periodic);
    Team one(1), three(3);
    MovingPairs alone(one), shared(three);
    Pairs pairs, same;
    for (int i = 0, reused = 0; reused < 5; ++i) {
      ASSERT_LT(i, 100);
      alone.find(dance.centres, dance.reach, dance.period(), pairs);
      shared.find(dance.centres, dance.reach, dance.period(), same);
      ASSERT_GT(shared.list().size(), 5000u);
      ASSERT_EQ(pairs, same) << i;
      ASSERT_EQ(alone.reused(), shared.reused());
      reused += alone.reused();
      dance.step();
    }
  }
}

// The list knows the pair only by the margin; one step within it brings them together.
TEST(MovingPairs, SeeADiscThatGrowsOrComesJustAsFarAsTheMargin) {
  const std::vector<double> reach{0.5, 0.5};
  for (double gap = 1.0; gap < 1.4; gap += 0.001) {
    Team alone(1);
    MovingPairs moving(alone);
    Pairs pairs;
    moving.find(std::vector<Point>{{0, 0}, {gap, 0}}, reach, nullptr, pairs);
    EXPECT_EQ(pairs.size(), gap <= 1.0 ? 1u : 0u);
    const double half = 0.5 * (gap - 1.0);
    const std::vector<Point> closer{{half, 0}, {gap - half, 0}};
    moving.find(closer, reach, nullptr, pairs);
    EXPECT_EQ(pairs, brute_force::pairs(closer, reach)) << gap;
    const std::vector<double> larger{0.5 + half, 0.5 + half};
    moving.find(std::vector<Point>{{0, 0}, {gap, 0}}, larger, nullptr, pairs);
    EXPECT_EQ(pairs, brute_force::pairs(std::vector<Point>{{0, 0}, {gap, 0}}, larger)) << gap;
  }
}

TEST(MovingPairs, StartAnewForOtherDiscs) {
  Team alone(1);
  MovingPairs moving(alone);
  Pairs pairs;
  const Period torus{{0, 0}, {8, 8}};
  for (const std::size_t n : {100u, 99u, 0u, 100u}) {
    Dance dance(7 + n, n, 8.0, 0.0, false);
    const std::vector<std::uint8_t> still(n, 0);
    for (const Period* period : {static_cast<const Period*>(nullptr), &torus}) {
      moving.find(dance.centres, dance.reach, period, pairs);
      EXPECT_EQ(pairs, brute_force::pairs(dance.centres, dance.reach, period));
      moving.find(dance.centres, dance.reach, period, pairs, still);
      EXPECT_TRUE(pairs.empty());
    }
  }
}

}  // namespace
}  // namespace throng::broadphase
