// SPDX-License-Identifier: MIT
#include "narrowphase/motion/motion.h"

#include <gtest/gtest.h>

#include <random>

namespace throng::narrowphase {
namespace {

TEST(Motion, GoesStraightAndTurnsAboutItsOrigin) {
  const Motion motion{{1.0, 2.0}, 0.5, {3.0, -1.0}, 2.0};
  const Pose later = pose_at(motion, 0.25), expected = pose({1.75, 1.75}, 1.0);
  EXPECT_EQ(later.position, expected.position);
  EXPECT_EQ(later.cos, expected.cos);
  EXPECT_EQ(later.sin, expected.sin);
}

TEST(GapRate, OfTwoDiscsThatMeetHeadOnIsTheirClosingSpeed) {
  const GapRate rate = gap_rate({{0, 0}, 0, {3, 0}, 0}, {{9, 0}, 0, {-1, 0}, 0});
  EXPECT_EQ(rate.of(1.0, 1.0), 4.0);
}

TEST(GapRate, IsNeverExceededByWhatPointsMoveRelativeToEachOther) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  const auto motion = [&] {
    return Motion{{any(random), any(random)}, any(random), {any(random), any(random)}, any(random)};
  };
  double tightest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Motion a = motion(), b = motion();
    const Vec p{any(random), any(random)}, q{any(random), any(random)};
    const double rate = gap_rate(a, b).of(p.norm(), q.norm());
    const double t = 1.0 + any(random) / 3.0, dt = 0.01;
    const Vec before = pose_at(b, t) * q - pose_at(a, t) * p;
    const Vec after = pose_at(b, t + dt) * q - pose_at(a, t + dt) * p;
    const double moved = (after - before).norm() / dt;
    EXPECT_LE(moved, rate * (1.0 + 1e-9)) << "seed 5, pair " << i;
    tightest = std::max(tightest, moved / rate);
  }
  EXPECT_GT(tightest, 0.95) << "the sample comes near the bound";
}

}  // namespace
}  // namespace throng::narrowphase
