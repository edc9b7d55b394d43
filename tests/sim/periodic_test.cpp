// SPDX-License-Identifier: MIT
#include "sim/periodic.h"

#include <gtest/gtest.h>

#include <cmath>

namespace throng {
namespace {

/// Whose size and least place don't add up to its greatest one.
Domain domain() {
  Domain result;
  result.min = {-1000.0, -0.3}, result.max = {0.1, 1e-3};
  return result;
}

TEST(Wrapped, LeavesWhoIsInsideWhereHeIs) {
  const Domain d = domain();
  for (const double x : {d.min.x(), -0.0, std::nextafter(d.max.x(), d.min.x()), -999.9}) {
    const Vec p(x, std::nextafter(d.max.y(), d.min.y()));
    EXPECT_EQ(wrapped(p, d), p);
  }
}

TEST(Wrapped, BringsAllOthersInsideByWholePeriods) {
  const Domain d = domain();
  const Vec size = d.max - d.min;
  for (const double far : {-3.0, -1.0, 1.0, 2.0, 1e6})
    for (const double part : {0.0, 0.3, 0.999}) {
      const Vec p = d.min + (far + part) * size, inside = wrapped(p, d);
      for (const int axis : {0, 1}) {
        EXPECT_GE(inside[axis], d.min[axis]);
        EXPECT_LT(inside[axis], d.max[axis]);
        const double periods = (p[axis] - inside[axis]) / size[axis];
        EXPECT_NEAR(periods, std::round(periods), 1e-9);
      }
    }
  EXPECT_EQ(wrapped(d.max, d), d.min);
  const Vec below(std::nextafter(d.min.x(), -2000.0), std::nextafter(d.min.y(), -1.0));
  EXPECT_GE(wrapped(below, d).x(), d.min.x());
  EXPECT_LT(wrapped(below, d).x(), d.max.x());
}

}  // namespace
}  // namespace throng
