// SPDX-License-Identifier: MIT
#include "narrowphase/motion/gap_parabola.h"

#include <gtest/gtest.h>

#include <limits>

#include "moving_shapes.h"
#include "narrowphase/distance.h"
#include "narrowphase/motion/parabola.h"

namespace throng::narrowphase {
namespace {

/// The definition: between the outermost vertices along the axis, `ahead` of the time that it belongs to.
double gap_along(const MovingConvexPair& pair, const TurningAxis& axis, double time, double ahead) {
  const Vec n = pose({0, 0}, ahead * axis.spin).rotate(axis.normal);
  const Pose pose_a = pair.pose_a(time + ahead), pose_b = pair.pose_b(time + ahead);
  double of_a = -std::numeric_limits<double>::infinity(), of_b = -of_a;
  for (const Vec& v : pair.a.vertices) of_a = std::max(of_a, dot(n, pose_a * v));
  for (const Vec& v : pair.b.vertices) of_b = std::min(of_b, dot(n, pose_b * v));
  return of_b - of_a - pair.radius;
}

struct AxisSample {
  PlacedPair placed;
  TurningAxis axis;
  double apart;
};

/// Along the normal of the two as they stand, which turns with one of them or by itself.
AxisSample sample_axis(Random& random, const MovingConvexPair& pair, double time) {
  const PlacedPair placed{pair.pose_a(time), pair.pose_b(time)};
  const double spins[] = {0.0, pair.spin_a, pair.spin_b, uniform(random, -3.0, 3.0)};
  const double spin = spins[random() % 4], apart = (pair.offset_at(time) + pair.arms).norm();
  const Vec normal = separation(pair.a, placed.a, pair.b, placed.b).normal;
  return {placed, {normal, spin, bend(pair, spin, apart)}, apart};
}

/// Until the gap's first sample below 0, of a thousand.
double closes(const MovingConvexPair& pair, const TurningAxis& axis, double time, double most) {
  for (int i = 1; i <= 1000; ++i)
    if (const double ahead = most * i / 1000.0; gap_along(pair, axis, time, ahead) < -1e-12) return ahead;
  return most;
}

/// Of both forms; a shape that doesn't turn often stands metres from its origin.
TEST(GapParabola, NeverHoldsLongerThanTheGap) {
  constexpr std::uint64_t kSeed = 20261121;
  Random random(kSeed);
  int open = 0, close = 0, longer = 0;
  double tightest = 0.0, tightest_by_vertex = 0.0;
  for (int trial = 0; trial < 4000; ++trial) {
    const MovingPairOfShapes p = trial % 2 ? random_swing(random) : random_motions(random);
    const double time = uniform(random, 0.0, 1.0), most = 1.0;
    const MovingConvexPair pair(p.a, p.motion_a, p.b, p.motion_b, time + most);
    const auto [placed, axis, apart] = sample_axis(random, pair, time);
    const GapParabola all = gap_parabola(pair, placed, axis, 0.0, most);
    const TurningAxis own{axis.normal, axis.spin, bend_of_origins(axis.spin, pair.speed, apart)};
    const GapParabola by_vertex = gap_parabola_by_vertex(pair, placed, own, 0.0, most);
    ASSERT_NEAR(all.gap, gap_along(pair, axis, time, 0.0), 1e-12) << "seed " << kSeed << ", trial " << trial;
    if (!(all.gap > 0.0)) continue;
    const double truth = closes(pair, axis, time, most);
    ASSERT_LE(all.holds, truth) << "seed " << kSeed << ", trial " << trial;
    ASSERT_LE(by_vertex.holds, truth) << "seed " << kSeed << ", trial " << trial;
    ASSERT_GE(by_vertex.holds, all.holds * (1.0 - 1e-9)) << "seed " << kSeed << ", trial " << trial;
    ++open, longer += by_vertex.holds > 1.01 * all.holds;
    if (truth == most) continue;
    ++close;
    tightest = std::max(tightest, all.holds / truth);
    tightest_by_vertex = std::max(tightest_by_vertex, by_vertex.holds / truth);
  }
  EXPECT_GT(open, 1500);
  EXPECT_GT(close, 500);
  EXPECT_GT(longer, 100);
  EXPECT_GT(tightest, 0.99);
  EXPECT_GT(tightest_by_vertex, 0.99);
}

/// A corner in the origin that its shape turns about goes straight along a wall, for good.
TEST(GapParabola, ByVertexHoldsForACornerThatItsShapeTurnsAbout) {
  const Convex wall = segment({-9, 0}, {9, 0}), wedge = convex({{0, 0}, {0.8, 1}, {-0.8, 1}});
  const MovingConvexPair pair(wall, {}, wedge, {{0, 1e-9}, 0, {2, 0}, 0.6}, 0.5);
  const PlacedPair placed{pair.pose_a(0.0), pair.pose_b(0.0)};
  EXPECT_LT(gap_parabola(pair, placed, {{0, 1}, 0.0, bend(pair, 0.0, 0.0)}, 0.0, 0.5).holds, 1e-4);
  EXPECT_EQ(gap_parabola_by_vertex(pair, placed, {{0, 1}, 0.0, 0.0}, 0.0, 0.5).holds, 0.5);
}

/// Along an axis that turns at 1 rad/s a rod at rest, 2 m long and across it, bends by 1 m/s² at both ends
/// and by 0.5 m/s² for where it stands; the ends come at 1 m/s.
TEST(GapParabola, ByVertexBendsAShapeThatStandsByHowFarItReaches) {
  const Convex point = disc(0.0), rod = segment({0, -1}, {0, 1});
  const MovingConvexPair pair(point, {{0, 0}, 0, {0, 0}, 1.0}, rod, {{0.5, 0}, 0, {0, 0}, 0}, 1.0);
  const PlacedPair placed{pair.pose_a(0.0), pair.pose_b(0.0)};
  const TurningAxis axis{{1, 0}, 1.0, bend_of_origins(1.0, 0.0, 0.5)};
  const double bends = 1.5;
  EXPECT_NEAR(gap_parabola_by_vertex(pair, placed, axis, 0.0, 1.0).holds,
              (std::sqrt(1.0 + 2.0 * bends * 0.5) - 1.0) / bends, 1e-12);
}

/// A keel 2 m wide, as flat as a circle of 100 km, that rolls 5e-11 m above a wall: ever new corners come
/// down, from root to root only half the way, and six steps leave them thousands of times as deep as they are
/// high.
TEST(GapParabola, HoldsNoLongerWhereRootsComeDownSlowly) {
  constexpr double kRadius = 1e5, kHigh = 5e-11;
  std::vector<Vec> keel{{0.0, 0.5}};
  for (int k = 0; k <= 20; ++k) keel.emplace_back(-std::ldexp(1.0, -k), std::ldexp(0.5 / kRadius, -2 * k));
  for (int k = 20; k >= 0; --k) keel.emplace_back(std::ldexp(1.0, -k), std::ldexp(0.5 / kRadius, -2 * k));
  const Convex wall = segment({-9, 0}, {9, 0}), rolls = convex(std::move(keel));
  const MovingConvexPair pair(wall, {}, rolls, {{0, kHigh}, 0, {0, 0}, -1.0}, 1.0);
  const PlacedPair placed{pair.pose_a(0.0), pair.pose_b(0.0)};
  const TurningAxis axis{{0, 1}, 0.0, bend(pair, 0.0, 0.0)}, origins{{0, 1}, 0.0, 0.0};
  ASSERT_LT(gap_along(pair, axis, 0.0, 1e-7), -1e-12) << "the gap is closed long before the first root";
  for (const GapParabola& gap : {gap_parabola(pair, placed, axis, 0.0, 1.0),
                                 gap_parabola_by_vertex(pair, placed, origins, 0.0, 1.0)}) {
    EXPECT_GT(gap.holds, 1e-10);
    EXPECT_GE(gap_along(pair, axis, 0.0, gap.holds), 0.0) << gap.holds;
  }
}

}  // namespace
}  // namespace throng::narrowphase
