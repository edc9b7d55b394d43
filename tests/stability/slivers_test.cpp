// SPDX-License-Identifier: MIT
// Slivers: a metre long, a millimetre thick.
#include <gtest/gtest.h>

#include "tests/stability/masonry.h"

namespace throng {
namespace {

constexpr double kLong = 1.0, kThin = 0.001;  // m

/// The lowest that any corner of any body stands (m).
double lowest(const Trial& run) {
  double least = 1e9;
  for (std::size_t i = 0; i < run.state.position.size(); ++i)
    for (const Vec& v : run.scene.shapes[run.scene.bodies.shape[i]].parts.at(0).vertices)
      least = std::min(least, (narrowphase::pose(run.state.position[i], run.state.angle[i]) * v).y());
  return least;
}

/// The lowest that any corner ever got (m), while nobody became faster than a fall makes.
double watch(Trial& run, int steps) {
  double deepest = 0.0;
  for (int i = 0; i < steps; ++i) {
    run.steps(1);
    deepest = std::min(deepest, lowest(run));
    EXPECT_LT(fastest(run.state), 20.0) << "step " << i;
  }
  return deepest;
}

/// The far end of one that lay flat was held by nobody: it rocked for ever, up to 4 cm in the floor.
TEST(Slivers, FallOnTheFloorAndLieStill) {
  for (const double dt : {0.01, 1.0 / 60})
    for (const double angle :
         {0.0, 0.001, 0.1, 0.5, 1.0, 1.4, 1.56}) {  // 1.5707 stands: a thousandth and less is its width
      Masonry site(dt);
      site.box({0.0, 0.6}, kLong, kThin, angle);
      Trial run(site.text());
      const double deepest = watch(run, 400);
      EXPECT_GT(deepest, -0.005) << "dt " << dt << ", angle " << angle;
      EXPECT_GT(lowest(run), -1e-4) << "dt " << dt << ", angle " << angle;
      EXPECT_NEAR(run.state.position[0].y(), 0.5 * kThin, 1e-4) << "dt " << dt << ", angle " << angle;
      EXPECT_LT(fastest(run.state) + std::abs(run.state.spin[0]), 1e-3) << "dt " << dt << ", angle " << angle;
    }
}

/// In substeps in which the lowest, who bears ten, sags by 0.02 mm.
TEST(Slivers, StandOnOneAnother) {
  Masonry site(0.01, 0.6, {0.0, 0.0}, 32);
  for (int i = 0; i < 10; ++i) site.box({0.0, (0.5 + i) * kThin}, kLong, kThin);
  Trial run(site.text());
  watch(run, 1000);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(run.state.position[i].y(), (0.5 + static_cast<double>(i)) * kThin, 0.3 * kThin) << i;
  EXPECT_LT(fastest(run.state), 1e-3);
}

TEST(Slivers, FallInAHeapAndStayAboveTheFloor) {
  for (const double dt : {0.01, 1.0 / 60}) {
    Masonry site(dt);
    for (int i = 0; i < 30; ++i) site.box({0.11 * (i % 5), 0.6 + 0.3 * i}, kLong, kThin, 0.7 * i);
    Trial run(site.text());
    const double deepest = watch(run, 1000);
    EXPECT_GT(deepest, -0.02) << "dt " << dt;
    EXPECT_GT(lowest(run), -2e-3) << "dt " << dt;  // where several bear down
    EXPECT_LT(fastest(run.state), 0.1) << "dt " << dt;
  }
}

}  // namespace
}  // namespace throng
