// SPDX-License-Identifier: MIT
#include "narrowphase/motion/clear_time.h"

#include <gtest/gtest.h>

#include "../random_shapes.h"
#include "narrowphase/distance.h"
#include "narrowphase/motion/motion.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {
namespace {

double far(const Convex& shape) {
  double most = 0.0;
  for (const Vec& v : shape.vertices) most = std::max(most, v.norm());
  return most + shape.radius;
}

/// At an instant of two motions, along the normal of their separation.
ClearTime clear_time_at(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                        double time, const ClearTime& wanted) {
  const Pose pose_a = pose_at(motion_a, time), pose_b = pose_at(motion_b, time);
  const Vec velocity = motion_b.velocity - motion_a.velocity;
  const OpenGap gap{{a.vertices, pose_a, far(a)},
                    {b.vertices, pose_b, far(b)},
                    separation(a, pose_a, b, pose_b).normal,
                    a.radius + b.radius};
  return clear_time(gap, {motion_a.spin, motion_b.spin, velocity, velocity.norm()}, wanted);
}

TEST(ClearTime, OfDiscsThatGoStraightIsTheirGapOverTheirClosingSpeed) {
  const ClearTime clear = clear_time_at(disc(1), {}, disc(1), {{5, 0}, 0, {-2, 7}, 0}, 0.0, {100.0, 100.0});
  EXPECT_NEAR(clear.after, 1.5, 1e-12);
  EXPECT_LE(clear.after, 1.5);
  EXPECT_NEAR(clear.before, 100.0, 1e-10) << "they come from far away";
}

TEST(ClearTime, OfWhatSlidesAlongAWallIsAllThatIsWanted) {
  const Convex floor = segment({-9, 0}, {9, 0}), box = convex({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const ClearTime clear = clear_time_at(floor, {}, box, {{-8, 1e-9}, 0, {5, 0}, 0}, 0.0, {3.0, 2.0});
  EXPECT_NEAR(clear.before, 3.0, 1e-10);
  EXPECT_NEAR(clear.after, 2.0, 1e-10);
}

/// A rod upright over a floor, turning about its middle: where it is lowest the gap has no slope, and 2e-6 of
/// it last about sqrt(2 2e-6 / (1 m 1 rad²/s²)) = 2 ms; over its rate they would last 2 us.
TEST(ClearTime, LastsAsTheRootOfTheGapWhereAMotionGrazes) {
  const ClearTime clear = clear_time_at(segment({-9, 0}, {9, 0}), {}, segment({0, -1}, {0, 1}),
                                        {{0, 1.0 + 2e-6}, 0, {0, 0}, 1.0}, 0.0, {1.0, 1.0});
  EXPECT_NEAR(clear.before, 2e-3, 1e-4);
  EXPECT_NEAR(clear.after, 2e-3, 1e-4);
}

/// A corner that stands in the origin about which its body turns goes straight, whatever the others do.
TEST(ClearTime, OfACornerThatItsBodyTurnsAboutIsAllThatIsWanted) {
  const Convex floor = segment({-9, 0}, {9, 0}), wedge = convex({{0, 0}, {0.8, 1}, {-0.8, 1}});
  const ClearTime clear = clear_time_at(floor, {}, wedge, {{0, 1e-9}, 0, {2, 0}, 0.6}, 0.0, {0.5, 0.5});
  EXPECT_NEAR(clear.before, 0.5, 1e-10);
  EXPECT_NEAR(clear.after, 0.5, 1e-10);
}

/// A thorn of a scene that stands still, and a floor that turns over it by a little.
TEST(ClearTime, IsTheSameWhereverAStaticSceneHasItsOrigin) {
  const Convex side = segment({-2, 0}, {2, 0});
  const auto above_thorn = [&](const Vec& far) {
    const Convex thorn = convex({far, far + Vec(0.2, -1), far + Vec(0.5, -1)});
    return clear_time_at(side, {far + Vec(0, 1e-6), 0, {1, 0}, 0.3}, thorn, {}, 0.0, {1.0, 1.0});
  };
  const ClearTime near = above_thorn({0, 0}), far = above_thorn({600, 800});
  EXPECT_GT(near.after, 1e-3) << "0.6 m/s² bend it";
  EXPECT_NEAR(far.after, near.after, 1e-6);
  EXPECT_NEAR(far.before, near.before, 1e-6);
}

TEST(ClearTime, IsNothingWhereRoundingMayHaveClosedTheGap) {
  const OpenGap gap{{{}, {}, 1.0}, {{}, Pose{{2, 0}}, 1.0}, {1, 0}, 2.0};
  const std::vector<Vec> centre{{0, 0}};
  OpenGap discs = gap;
  discs.a.vertices = discs.b.vertices = centre;
  const ClearTime clear = clear_time(discs, {0.0, 0.0, {5, 0}, 5.0}, {1.0, 1.0});
  EXPECT_EQ(clear.before, 0.0);
  EXPECT_EQ(clear.after, 0.0);
}

/// The same body, whose origin lies elsewhere: it must not turn.
void set_origin(const Vec& origin, Convex& shape, Motion& motion) {
  for (Vec& v : shape.vertices) v -= origin;
  motion.position += pose({0, 0}, motion.angle).rotate(origin);
}

/// Of random shapes and motions, some with their origins far away, against steps of a thousandth.
TEST(ClearTime, NeverLastsBeyondAContact) {
  Random random(20261121);
  int asked = 0, ended = 0;
  double tightest = 0.0;
  for (int trial = 0; trial < 4000; ++trial) {
    Convex a = random_shape(random, 1.0), b = random_shape(random, 1.0);
    const auto motion = [&] {
      const Vec at = random_vec(random, 2, 2), velocity = random_vec(random, 3, 3);
      const double angle = uniform(random, -4, 4), spin = random() % 3 == 0 ? 0.0 : uniform(random, -6, 6);
      return Motion{at - velocity, angle, velocity, spin};
    };
    Motion motion_a = motion(), motion_b = motion();
    const double far = trial % 2 ? 10.0 : 0.0;
    if (motion_a.spin == 0.0) set_origin(random_vec(random, far, far), a, motion_a);
    if (motion_b.spin == 0.0) set_origin(random_vec(random, far, far), b, motion_b);
    const auto distance = [&](double t) {
      return separation(a, pose_at(motion_a, t), b, pose_at(motion_b, t)).distance;
    };
    if (distance(1.0) <= 0.0) continue;
    const ClearTime clear = clear_time_at(a, motion_a, b, motion_b, 1.0, {1.0, 1.0});
    ++asked;
    double after = 0.0, before = 0.0;
    while (after < 1.0 && distance(1.0 + after) > 0.0) after += 1e-3;
    while (before < 1.0 && distance(1.0 - before) > 0.0) before += 1e-3;
    ASSERT_LE(clear.after, after) << "seed 20261121, trial " << trial;
    ASSERT_LE(clear.before, before) << "seed 20261121, trial " << trial;
    if (after < 1.0) ++ended, tightest = std::max(tightest, clear.after / after);
  }
  RecordProperty("tightest", std::to_string(tightest));
  EXPECT_GT(asked, 1500);
  EXPECT_GT(ended, 300);
  EXPECT_GT(tightest, 0.95);
}

}  // namespace
}  // namespace throng::narrowphase
