// SPDX-License-Identifier: MIT
// What hits without a bounce: all that stops it does so at once, so that hardly anything comes back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/sim/trial.h"

namespace throng {
namespace {

std::string without_bounces(const std::string& gravity) {
  return "sleep = false\ngravity = " + gravity +
         "\ntime = { dt = 0.01, until = 2, substeps = 4 }\nmaterials.default = { friction = 0, restitution = "
         "0 "
         "}\nmaterials.light = { friction = 0, restitution = 0, density = 0.1 }\n[shapes]\n"
         "ball.disc.radius = 0.5\npost.disc.radius = 0.2\n"
         "block.polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]\n";
}

std::string one(const std::string& shape, double x, double y, const std::string& more = "") {
  return "[[bodies]]\nshape = '" + shape + "'\nat = [" + std::to_string(x) + ", " + std::to_string(y) +
         "]\n" + more;
}

/// The fastest of the first `bodies` in the direction, over the fastest that was against it before.
double share_that_comes_back(Trial& run, std::size_t bodies, const Vec& direction, int steps) {
  double there = 0.0, back = 0.0;
  for (int i = 0; i < steps; ++i) {
    run.steps(1);
    for (std::size_t row = 0; row < bodies; ++row) {
      const double speed = direction.dot(run.state.velocity[row]);
      if (-speed > there) there = -speed, back = 0.0;
      back = std::max(back, speed);
    }
  }
  return back / there;
}

// Stopped by the one and then by the other, it came up with up to a half of its speed, or slid off sideways.
TEST(Hits, OnTwoPostsAtOnceADiscStays) {
  for (const double half : {0.1, 0.2, 0.3, 0.45, 0.6, 0.65, 0.68}) {
    Trial run(without_bounces("[0, -9.81]") + one("ball", 0, 1.7) +
              one("post", -half, 0, "kind = 'static'\n") + one("post", half, 0, "kind = 'static'\n"));
    EXPECT_LT(share_that_comes_back(run, 1, {0, 1}, 100), 0.01) << half;
    EXPECT_LT(std::abs(run.state.position[0].x()), 0.01) << half;
  }
}

TEST(Hits, IntoAVADiscStays) {
  for (const double angle : {10.0, 20.0, 35.0, 45.0, 60.0, 70.0}) {
    const double c = std::cos(angle * M_PI / 180.0), s = std::sin(angle * M_PI / 180.0);
    const std::string x = std::to_string(9 * c), y = std::to_string(9 * s);
    Trial run(without_bounces("[0, -9.81]") + one("ball", 0, 1.0 + 0.5 / c) + "[[walls]]\npolyline = [[-" +
              x + ", " + y + "], [0, 0], [" + x + ", " + y + "]]\n");
    EXPECT_LT(share_that_comes_back(run, 1, {0, 1}, 100), 0.01) << angle;
  }
}

TEST(Hits, AStackThatFallsLies) {
  for (const char* shape : {"ball", "block"})
    for (const auto& [count, share] : {std::pair{2, 0.003}, {3, 0.006}, {5, 0.012}, {10, 0.03}}) {
      std::string text = without_bounces("[0, -9.81]") + "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n";
      for (int i = 0; i < count; ++i) text += one(shape, 0, 2.5 + i);
      Trial run(text);
      EXPECT_LT(share_that_comes_back(run, static_cast<std::size_t>(count), {0, 1}, 120), share)
          << count << " of " << shape;
    }
}

/// At round numbers bodies arrive just as a substep ends. A version that left alone what was to be struck by
/// rounding alone stopped them point after point: squares turned by up to 2.4 rad/s, and bells came back with
/// 4.5 % of their speed.
TEST(Hits, FlatlyAreStoppedAtOnceWhereverInASubstepTheyAre) {
  const std::string shapes =
      "square.polygon = [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]]\n"
      "bell.discs = [[0, -0.3, 0.2], [0, 0.3, 0.2]]\n";
  for (const char* shape : {"square", "bell"})
    for (const double speed : {1.0, 2.0, 4.0, 5.0, 8.0, 10.0, 20.0})
      for (const double gap : {0.5, 1.0, 2.0})
        for (const bool pair : {false, true}) {
          const std::string there = pair ? one(shape, 0, 0) : "[[walls]]\nsegment = [[0, -9], [0, 9]]\n";
          Trial run(
              without_bounces("[0, 0]") + shapes +
              one(shape, gap + (pair ? 0.4 : 0.2), 0, "velocity = [-" + std::to_string(speed) + ", 0]\n") +
              there);
          for (int step = 0; step < 250; ++step) {
            run.steps(1);
            ASSERT_LT(std::abs(run.state.spin[0]), 1e-9 * speed)
                << shape << " at " << speed << " from " << gap;
            ASSERT_LT(run.state.velocity[0].x(), 1e-9 * speed) << shape << " at " << speed << " from " << gap;
          }
        }
}

TEST(Hits, ABlowThroughARowToAWallThrowsNobodyBack) {
  for (const char* material : {"default", "light"})
    for (const int count : {2, 5}) {
      std::string text = without_bounces("[0, 0]") + "[[walls]]\nsegment = [[0, -9], [0, 9]]\n" +
                         one("ball", count + 0.94, 0, "velocity = [-4, 0]\n");
      for (int i = 0; i < count; ++i)
        text += one("ball", 0.5 + i, 0, "material = '" + std::string(material) + "'\n");
      Trial run(text);
      EXPECT_LT(share_that_comes_back(run, static_cast<std::size_t>(count) + 1, {1, 0}, 100), 0.01)
          << count << " of " << material;
    }
}

}  // namespace
}  // namespace throng
