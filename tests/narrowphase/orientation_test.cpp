// SPDX-License-Identifier: MIT
#include "narrowphase/orientation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random_shapes.h"

namespace throng::narrowphase {
namespace {

TEST(Orientation, KnowsLeftFromRight) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0.5, 1}), 1);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0.5, -1}), -1);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {7, 0}), 0);
}

// The points of a tiny grid about (0.5, 0.5) against the line through (12, 12) and (24, 24), after Kettner
// and others (2008): plain arithmetic gets hundreds of them wrong. Here the answer is known: it is the sign
// of y - x.
TEST(Orientation, IsRightWhereRoundingIsWrong) {
  constexpr double kUlp = 0x1p-53;
  int naive_wrong = 0;
  for (int i = 0; i < 128; ++i)
    for (int j = 0; j < 128; ++j) {
      const Vec a{12, 12}, b{24, 24}, c{0.5 + i * kUlp, 0.5 + j * kUlp};
      const int exact = (c.y() > c.x()) - (c.y() < c.x());
      ASSERT_EQ(orientation(a, b, c), exact) << i << " " << j;
      const double naive = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
      naive_wrong += ((naive > 0) - (naive < 0)) != exact;
    }
  EXPECT_GT(naive_wrong, 1000);
}

TEST(Orientation, IsThatOfIntegersOnEveryScaleAndInEveryOrder) {
  Random random(5);
  int collinear = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto grid = [&] {
      return static_cast<long long>(random() % 7) * ((1LL << 40) + 1) + static_cast<long long>(random() % 3);
    };
    const long long ax = grid(), ay = grid(), bx = grid(), by = grid(), cx = grid(), cy = grid();
    const __int128 determinant =
        static_cast<__int128>(bx - ax) * (cy - ay) - static_cast<__int128>(by - ay) * (cx - ax);
    const int exact = (determinant > 0) - (determinant < 0);
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 600) - 300);
    const auto vec = [scale](long long x, long long y) {
      return Vec(static_cast<double>(x) * scale, static_cast<double>(y) * scale);
    };
    const Vec a = vec(ax, ay), b = vec(bx, by), c = vec(cx, cy);
    ASSERT_EQ(orientation(a, b, c), exact) << i;
    ASSERT_EQ(orientation(b, c, a), exact) << i;
    ASSERT_EQ(orientation(c, b, a), -exact) << i;
    collinear += exact == 0;
  }
  EXPECT_GT(collinear, 1000);
}

}  // namespace
}  // namespace throng::narrowphase
