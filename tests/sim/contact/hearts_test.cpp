// SPDX-License-Identifier: MIT
#include "sim/contact/hearts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace throng {
namespace {

using narrowphase::convex;
using narrowphase::Convex;

TEST(Hearts, ABarIsHalfAsThickAsItIsWide) {
  const Convex bar = convex({{-0.5, -0.01}, {0.5, -0.01}, {0.5, 0.01}, {-0.5, 0.01}});
  EXPECT_NEAR(thickness(bar), 0.02 / 2.04, 1e-15);
  EXPECT_EQ(thickness(narrowphase::disc(0.3)), 0.3);
  EXPECT_EQ(thickness(narrowphase::segment({0, 0}, {1, 0})), 0.0);
  EXPECT_EQ(thickness(narrowphase::segment({0, 0}, {1, 0}, 0.1)), 0.1);
}

TEST(Hearts, AnInsetLiesSoFarBelowEachEdge) {
  const Convex part = inset(convex({{0, 0}, {4, 0}, {4, 2}, {0, 2}}), 0.5);
  ASSERT_EQ(part.vertices.size(), 4u);
  for (const Vec& v : part.vertices) {
    EXPECT_NEAR(std::abs(v.x() - 2.0), 1.5, 1e-15);
    EXPECT_NEAR(std::abs(v.y() - 1.0), 0.5, 1e-15);
  }
}

TEST(Hearts, AnInsetTakesTheRadiusFirst) {
  EXPECT_EQ(inset(narrowphase::disc(0.3), 0.2).radius, 0.3 - 0.2);
  const Convex part = inset(convex({{0, 0}, {4, 0}, {4, 2}, {0, 2}}, 0.25), 0.5);
  EXPECT_EQ(part.radius, 0.0);
  for (const Vec& v : part.vertices) EXPECT_NEAR(std::abs(v.y() - 1.0), 0.75, 1e-15);
}

/// Of a wedge whose short edge is gone before the heart is reached.
TEST(Hearts, AnInsetLosesEdgesThatItSwallows) {
  const Convex part = inset(convex({{0, 0}, {10, -2}, {10, 2}, {0, 0.01}}), 0.5);
  EXPECT_EQ(part.vertices.size(), 3u);
}

/// Against its definition: a point is in it where it lies so far below every edge.
TEST(Hearts, OfAnyPolygonAPointIsInItsInsetWhereItLiesDeepEnough) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int in = 0, out = 0;
  for (int i = 0; i < 300; ++i) {
    const int n = 3 + i % 9;
    std::vector<Vec> vertices;
    for (int k = 0; k < n; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.8 * unit(random)) / n;
      vertices.emplace_back(std::cos(angle), 0.1 * (1 + i % 10) * std::sin(angle));
    }
    const Convex part = convex(vertices);
    double signed_area = 0.0;
    for (std::size_t k = 2; k < vertices.size(); ++k) {
      const Vec p = vertices[k - 1] - vertices[0], q = vertices[k] - vertices[0];
      signed_area += p.x() * q.y() - p.y() * q.x();
    }
    ASSERT_GT(signed_area, 0.0);
    for (const double share : Hearts::kRims) {
      const double rim = share * thickness(part);
      const Convex heart = inset(part, rim);
      ASSERT_GE(heart.vertices.size(), 3u);
      for (int k = 0; k < 200; ++k) {
        const Vec p(2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0);
        double depth = 1e9, of_heart = 1e9;
        for (std::size_t e = 0; e < part.normals.size(); ++e)
          depth = std::min(depth, part.normals[e].dot(part.vertices[e] - p));
        for (std::size_t e = 0; e < heart.normals.size(); ++e)
          of_heart = std::min(of_heart, heart.normals[e].dot(heart.vertices[e] - p));
        if (std::abs(depth - rim) < 1e-12) continue;
        EXPECT_EQ(depth > rim, of_heart > 0.0) << i << ", rim " << rim << ", depth " << depth;
        ++(depth > rim ? in : out);
      }
    }
  }
  EXPECT_GT(in, 1000);
  EXPECT_GT(out, 1000);
}

}  // namespace
}  // namespace throng
