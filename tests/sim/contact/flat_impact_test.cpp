// SPDX-License-Identifier: MIT
#include "sim/contact/flat_impact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sim/contact/arms.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// A box of 1 kg, 2 m wide and `height` m high, that moves at (vx, -vy) m/s without spin on a floor.
struct Landing {
  SolverBody floor{}, box{};
  PointContact left, right;

  Landing(double height, double vx, double vy, double friction) {
    floor.velocity = {0, 0}, box.velocity = {vx, -vy};
    box.inverse_mass = 1.0, box.inverse_inertia = 12.0 / (4.0 + height * height);
    for (auto [corner, x] : {std::pair(&left, -1.0), {&right, 1.0}}) {
      corner->normal = {0, 1};
      corner->arm_a = {x, 0}, corner->arm_b = {x, -0.5 * height};
      corner->friction = friction;
    }
  }

  /// By so much (m/s) is the normal velocity to change at both.
  FlatImpact strike(double added) {
    const auto impact = flat_impact(left, right, floor, box, {added, added}, {added, added});
    EXPECT_TRUE(impact);
    if (!impact) return {};
    apply(*impact, left, right, floor, box);
    return *impact;
  }
  double energy() const {
    return 0.5 * box.velocity.squaredNorm() + 0.5 * box.spin * box.spin / box.inverse_inertia;
  }
};

TEST(FlatImpact, StopsWhatSlidesMoreSlowlyThanFrictionCan) {
  for (const double vx : {-0.49, -0.1, 0.05, 0.3, 0.5}) {
    Landing landing(0.5, vx, 1.0, 0.5);
    const FlatImpact impact = landing.strike(1.0);
    EXPECT_NEAR(landing.box.velocity.norm(), 0.0, 1e-15) << vx;
    EXPECT_NEAR(landing.box.spin, 0.0, 1e-15) << vx;
    EXPECT_NEAR(impact.normal_i + impact.normal_j, 1.0, 1e-15);
    EXPECT_LE(std::abs(impact.across_i), 0.5 * impact.normal_i * (1 + 1e-12));
    EXPECT_LE(std::abs(impact.across_j), 0.5 * impact.normal_j * (1 + 1e-12));
  }
}

TEST(FlatImpact, SlowsWhatSlidesFasterByCoulombsImpulse) {
  for (const double e : {0.0, 0.5, 1.0})
    for (const double vx : {-3.0, 2.0}) {
      Landing landing(0.5, vx, 1.0, 0.25);
      landing.strike(1.0 + e);
      EXPECT_NEAR(landing.box.velocity.y(), e, 1e-15);
      EXPECT_NEAR(landing.box.velocity.x(), vx - std::copysign(0.25 * (1.0 + e), vx), 1e-15);
      EXPECT_NEAR(landing.box.spin, 0.0, 1e-15) << "it stays flat";
    }
}

TEST(FlatImpact, InTwoStrikesIsThatInOne) {
  for (const double vx : {0.1, 0.45, 0.9, 3.0})
    for (const double friction : {0.2, 0.5, 0.9}) {
      Landing one(2.0, vx, 1.0, friction), two(2.0, vx, 1.0, friction);
      one.strike(1.0);
      for (const double added : {0.3, 0.7}) {
        const double left = -arms(two.left).normal_velocity(two.floor, two.box);
        const auto impact = flat_impact(two.left, two.right, two.floor, two.box, {added, added}, {left, left});
        ASSERT_TRUE(impact);
        apply(*impact, two.left, two.right, two.floor, two.box);
      }
      EXPECT_NEAR((two.box.velocity - one.box.velocity).norm(), 0.0, 1e-14) << vx << " " << friction;
      EXPECT_NEAR(two.box.spin, one.box.spin, 1e-14);
    }
}

/// Friction would lift the corner behind: the body tips over the one in front, which goes on as it is to.
TEST(FlatImpact, TipsWhatIsTallAndRubsHard) {
  Landing landing(8.0, 3.0, 1.0, 1.0);
  const FlatImpact impact = landing.strike(1.0);
  EXPECT_EQ(impact.normal_i, 0.0) << "behind";
  EXPECT_GT(impact.normal_j, 0.0);
  EXPECT_LT(landing.box.spin, 0.0) << "forwards";
  EXPECT_NEAR(arms(landing.right).normal_velocity(landing.floor, landing.box), 0.0, 1e-14);
  EXPECT_GT(arms(landing.left).normal_velocity(landing.floor, landing.box), 0.0);
}

TEST(FlatImpact, IsNoneAtOnePointOrWhereOneWouldPull) {
  Landing landing(0.5, 0.0, 1.0, 0.5);
  const AtPoints same{1.0, 1.0}, one_pulls{9.0, 1e-3};
  EXPECT_FALSE(flat_impact(landing.left, landing.left, landing.floor, landing.box, same, same));
  landing.left.arm_a.x() = landing.left.arm_b.x() = 0.8;
  EXPECT_FALSE(flat_impact(landing.left, landing.right, landing.floor, landing.box, one_pulls, one_pulls));
}

/// Newton's law of restitution with Coulomb's of friction may give energy (Kane and Levinson 1985).
TEST(FlatImpact, TakesNoEnergyInHoweverBodiesMeet) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int struck = 0;
  for (int i = 0; i < 20'000; ++i) {
    Landing landing(std::exp(2.0 * any(engine)), 4.0 * any(engine), 1.0 + any(engine), 1.0 + any(engine));
    landing.box.spin = any(engine);
    landing.floor.velocity = {any(engine), any(engine)};
    landing.floor.inverse_mass = 1.0 + any(engine), landing.floor.inverse_inertia = 1.0 + any(engine);
    const double e = 0.5 + 0.5 * any(engine);
    const auto nearing = [&](const PointContact& at) {
      return -arms(at).normal_velocity(landing.floor, landing.box);
    };
    const double left = nearing(landing.left), right = nearing(landing.right);
    if (!(left > 0.0 && right > 0.0)) continue;
    const auto energy = [](const SolverBody& body) {
      const double turning = body.inverse_inertia > 0.0 ? body.spin * body.spin / body.inverse_inertia : 0.0;
      return 0.5 * body.velocity.squaredNorm() / body.inverse_mass + 0.5 * turning;
    };
    const double before = energy(landing.box) + energy(landing.floor);
    const AtPoints added{(1.0 + e) * left, (1.0 + e) * right};
    const auto impact = flat_impact(landing.left, landing.right, landing.floor, landing.box, added, added);
    if (!impact) continue;
    ++struck;
    apply(*impact, landing.left, landing.right, landing.floor, landing.box);
    ASSERT_LE(energy(landing.box) + energy(landing.floor), before * (1.0 + 1e-12)) << i;
    ASSERT_GE(std::min(impact->normal_i, impact->normal_j), 0.0);
    ASSERT_LE(std::abs(impact->across_i), landing.left.friction * impact->normal_i * (1 + 1e-9) + 1e-12);
  }
  EXPECT_GT(struck, 5000);
}

// As a stranger had it: up to a slip of an eighth of the speed of landing friction did nothing at all, and
// slips up to it were stopped by three fifths.
TEST(FlatImpact, OfABoxThatLandsIsCoulombs) {
  for (const double e : {0.0, 1.0})
    for (const double friction : {0.2, 0.5, 2.0})
      for (const double vx : {0.05, 0.15, 0.4, 1.0, 3.0})
        for (const double y : {0.3, 0.3003, 0.30071, 0.31}) {
          Trial run("time = { dt = 0.002, until = 1 }\n" + material(e, friction) +
                    "[shapes]\nbox = { polygon = [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]] }\n"
                    "[[bodies]]\nshape = 'box'\nat = [0, " +
                    std::to_string(y) + "]\nvelocity = [" + std::to_string(vx) +
                    ", -1]\n[[walls]]\nsegment = [[-9, 0], [9, 0]]\n");
          run.steps(60);
          const double most = friction * (1.0 + e);
          const bool tips = std::min(vx, most) >= 1.0 + e;  // as wide as high
          if (tips) continue;
          SCOPED_TRACE(testing::Message() << "e " << e << " friction " << friction << " vx " << vx << " y " << y);
          const double slack = friction < 1.0 ? 1e-12 : 5e-6;  // sweeps of contacts end what is hardly a hit
          EXPECT_NEAR(run.state.velocity[0].x(), std::max(vx - most, 0.0), slack);
          EXPECT_NEAR(run.state.velocity[0].y(), e, slack);
          EXPECT_NEAR(run.state.spin[0], 0.0, 5.0 * slack);
        }
}

}  // namespace
}  // namespace throng
