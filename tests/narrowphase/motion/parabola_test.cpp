// SPDX-License-Identifier: MIT
#include "narrowphase/motion/parabola.h"

#include <gtest/gtest.h>

#include <limits>

namespace throng::narrowphase {
namespace {

TEST(Parabola, ComesDownWhereItsFormulaSays) {
  EXPECT_EQ((Parabola{4.0, 0.0, 2.0}.root()), 2.0);
  EXPECT_EQ((Parabola{6.0, -1.0, 4.0}.root()), 1.5);
  EXPECT_EQ((Parabola{6.0, 1.0, 4.0}.root()), 2.0);
  EXPECT_EQ((Parabola{6.0, -2.0, 0.0}.root()), 3.0);
  EXPECT_EQ((Parabola{6.0, 0.0, 0.0}.root()), std::numeric_limits<double>::infinity());
  EXPECT_EQ((Parabola{6.0, 2.0, 0.0}.root()), std::numeric_limits<double>::infinity());
}

/// No root depends on the unit of length: to the last bit, for powers of two.
TEST(Parabola, ComesDownAtTheSameTimeInAnyUnit) {
  for (const Parabola& p : {Parabola{3, -1, 2}, Parabola{3, 1, 2}, Parabola{3, 0, 2}, Parabola{3, -1, 0}})
    for (const int exponent : {-1070, -900, -540, -300, 300, 540, 900, 1020}) {
      const double unit = std::ldexp(1.0, exponent);
      EXPECT_EQ((Parabola{unit * p.gap, unit * p.rate, unit * p.bend}.root()), p.root()) << exponent;
    }
}

TEST(Parabola, ComesDownNoLaterWhereSquaresOverflow) {
  const double spin = 3e153, bend = 5.0 * spin * spin;
  for (const double rate : {0.0, 1.0, -1.0}) {
    const double root = Parabola{4.0, rate, bend}.root();
    EXPECT_NEAR(root / std::sqrt(8.0 / bend), 1.0, 1e-12) << rate;
  }
  EXPECT_EQ((Parabola{4.0, 1.0, std::numeric_limits<double>::infinity()}.root()), 0.0);
  EXPECT_EQ((Parabola{4.0, std::numeric_limits<double>::quiet_NaN(), 1.0}.root()), 0.0);
}

}  // namespace
}  // namespace throng::narrowphase
