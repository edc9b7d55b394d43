// SPDX-License-Identifier: MIT
#include "sim/crowd/velocity_obstacle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "narrowphase/crossing.h"

namespace throng {
namespace {

struct Line {
  Vec a, b;
  double radius, horizon;

  /// The definition: within the horizon, going at v meets what is round the line.
  bool meets(const Vec& v) const {
    const Vec end = horizon * v;
    if (narrowphase::segments_meet(Vec(0, 0), end, a, b)) return true;
    const auto gap = [](const Vec& p, const Vec& q, const Vec& from) {
      return (nearest_on_segment(p, q, from) - from).norm();
    };
    return std::min({gap(a, b, Vec(0, 0)), gap(a, b, end), gap(Vec(0, 0), end, a), gap(Vec(0, 0), end, b)}) <
           radius;
  }
};

class RandomLines {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Vec within(double size) {
    const double x = uniform(-size, size);
    const double y = uniform(-size, size);
    return {x, y};
  }
  Line line() {
    for (;;) {
      const Vec a = within(4.0), b = uniform(0, 1) < 0.5 ? a : within(4.0);
      const Line line{a, b, uniform(0.2, 1.0), uniform(0.5, 4.0)};
      if ((nearest_on_segment(a, b, Vec(0, 0))).norm() > 1.01 * line.radius) return line;
    }
  }

 private:
  std::mt19937_64 engine_{11};
};

TEST(VelocityObstacle, OfADiscAheadHasAFrontAndTwoLegs) {
  const Vec disc(4, 0);  // legs 30 degrees off the axis
  const Escape front = escape(disc, disc, 2.0, 2.0, {0.8, 0});
  EXPECT_NEAR((front.point - Vec(1, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((front.normal - Vec(-1, 0)).norm(), 0.0, 1e-15);
  const Escape left = escape(disc, disc, 2.0, 2.0, {4, 2});
  EXPECT_NEAR((left.normal - Vec(-0.5, std::sqrt(0.75))).norm(), 0.0, 1e-15);
  EXPECT_NEAR(left.point.y() / left.point.x(), std::tan(std::acos(-1.0) / 6), 1e-15);
  EXPECT_LT(escape(disc, disc, 2.0, 2.0, {4, -1}).normal.y(), 0.0);
}

TEST(VelocityObstacle, OfAWallAheadStopsBeforeIt) {
  const Escape ahead = escape({2, -9}, {2, 9}, 0.5, 3.0, {1, 0.2});
  EXPECT_NEAR((ahead.point - Vec(0.5, 0.2)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((ahead.normal - Vec(-1, 0)).norm(), 0.0, 1e-15);
}

TEST(VelocityObstacle, LiesBehindTheLineOfItsEscape) {
  RandomLines draw;
  int met = 0, trials = 300;
  for (int trial = 0; trial < trials; ++trial) {
    const Line line = draw.line();
    const Escape out = escape(line.a, line.b, line.radius, line.horizon, draw.within(4.0));
    EXPECT_NEAR(out.normal.norm(), 1.0, 1e-14);
    for (int i = 0; i < 200; ++i) {
      const Vec w = draw.within(6.0);
      if (!line.meets(w)) continue;
      ++met;
      ASSERT_LE(out.normal.dot(w - out.point), 1e-12) << "seed 11, trial " << trial;
    }
  }
  EXPECT_GT(met, 5 * trials) << "the sample meets some";
}

TEST(VelocityObstacle, HasNoNearerBorder) {
  RandomLines draw;
  int inside = 0, trials = 600;
  for (int trial = 0; trial < trials; ++trial) {
    const Line line = draw.line();
    const Vec v = draw.within(4.0);
    const Escape out = escape(line.a, line.b, line.radius, line.horizon, v);
    EXPECT_FALSE(line.meets(out.point + 1e-6 * out.normal)) << "seed 11, trial " << trial;
    EXPECT_TRUE(line.meets(out.point - 1e-6 * out.normal)) << "seed 11, trial " << trial;
    const double distance = (out.point - v).norm();
    inside += line.meets(v);
    for (int i = 0; i < 200; ++i) {
      const Vec by = draw.within(1.0);
      if (by.norm() >= 1.0) continue;
      ASSERT_EQ(line.meets(v + (distance - 1e-6) * by), line.meets(v)) << "seed 11, trial " << trial;
    }
  }
  EXPECT_GT(inside, trials / 10) << "some are inside,";
  EXPECT_LT(inside, trials * 9 / 10) << "some are not";
}

}  // namespace
}  // namespace throng
