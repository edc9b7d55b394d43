// SPDX-License-Identifier: MIT
#include "sim/contact/corner_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/contact/arms.h"
#include "tests/sim/contact/energy.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// Two bodies that near each other at any point along any normal, whatever they are like.
struct Meeting {
  SolverBody a{}, b{};
  PointContact at;

  explicit Meeting(std::mt19937_64& engine) {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const auto vec = [&] {
      const double x = any(engine);
      return Vec(x, any(engine));
    };
    do {
      at.normal = vec().normalized(), at.arm_a = vec(), at.arm_b = vec(), at.friction = 1.0 + any(engine);
      for (SolverBody* body : {&a, &b}) {
        body->velocity = 2.0 * vec(), body->spin = 2.0 * any(engine);
        body->inverse_mass = std::exp(2.0 * any(engine)), body->inverse_inertia = std::exp(2.0 * any(engine));
      }
    } while (!(nearing() > 0.1));
  }
  double nearing() const { return -arms(at).normal_velocity(a, b); }
  void apply(const CornerImpact& impact) { arms(at).apply(a, b, impact.normal, impact.across); }
};

/// Impulse by little impulse, until the normal one has given back e² of the work that it took.
CornerImpact in_small_steps(Meeting meeting, double restitution, double step) {
  const PointArms arms = throng::arms(meeting.at);
  CornerImpact sum{0.0, 0.0};
  double taken = 0.0, given = 0.0;
  for (;;) {
    const double before = arms.normal_velocity(meeting.a, meeting.b);
    if (before >= 0.0 && given >= restitution * restitution * taken) return sum;
    const double mass = effective_mass(meeting.a, meeting.b, arms.arm_a, arms.arm_b, arms.t);
    arms.apply(meeting.a, meeting.b, step, 0.0);
    const double stops = -mass * arms.tangent_velocity(meeting.a, meeting.b);
    const double across = std::clamp(stops, -meeting.at.friction * step, meeting.at.friction * step);
    arms.apply(meeting.a, meeting.b, 0.0, across);
    sum.normal += step, sum.across += across;
    const double work = 0.5 * (before + arms.normal_velocity(meeting.a, meeting.b)) * step;
    (work < 0.0 ? taken : given) += std::abs(work);
  }
}

TEST(CornerImpact, IsWhatManySmallImpulsesMake) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int round = 0; round < 300; ++round) {
    const Meeting meeting(engine);
    const double e = round % 3 == 0 ? 0.0 : part(engine);
    const CornerImpact impact =
        corner_impact(arms(meeting.at), meeting.at.friction, meeting.a, meeting.b, e * meeting.nearing());
    const double step = 1e-4 * impact.normal;
    const CornerImpact sum = in_small_steps(meeting, e, step);
    EXPECT_NEAR(impact.normal, sum.normal, 30.0 * step) << round;
    EXPECT_NEAR(impact.across, sum.across, 60.0 * step) << round;
  }
}

TEST(CornerImpact, TakesNoEnergyInAndKeepsItAllWithoutFriction) {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int round = 0; round < 50'000; ++round) {
    Meeting meeting(engine);
    if (round % 4 == 0) meeting.at.friction = 0.0;
    const double e = round % 8 == 0 ? 1.0 : part(engine);
    const double before = energy(meeting.a) + energy(meeting.b), nearing = meeting.nearing();
    const CornerImpact impact =
        corner_impact(arms(meeting.at), meeting.at.friction, meeting.a, meeting.b, e * nearing);
    meeting.apply(impact);
    const double after = energy(meeting.a) + energy(meeting.b);
    ASSERT_LE(after, before * (1.0 + 1e-12)) << round;
    ASSERT_GE(impact.normal, 0.0);
    ASSERT_LE(std::abs(impact.across), meeting.at.friction * impact.normal * (1.0 + 1e-12));
    if (meeting.at.friction > 0.0) continue;
    ASSERT_NEAR(-meeting.nearing(), e * nearing, 1e-12 * (1.0 + nearing)) << round;
    ASSERT_GE(after, (e == 1.0 ? 1.0 - 1e-12 : 0.0) * before);
  }
}

/// What is slowed at first, and stopped later, is as if it were stopped at once.
TEST(CornerImpact, GoesOnWhereItEnded) {
  std::mt19937_64 engine(5);
  for (int round = 0; round < 2000; ++round) {
    Meeting one(engine), two = one;
    one.apply(corner_impact(arms(one.at), one.at.friction, one.a, one.b, 0.0));
    two.apply(corner_impact(arms(two.at), two.at.friction, two.a, two.b, -0.3 * two.nearing()));
    two.apply(corner_impact(arms(two.at), two.at.friction, two.a, two.b, 0.0));
    ASSERT_NEAR((one.a.velocity - two.a.velocity).norm() + std::abs(one.b.spin - two.b.spin), 0.0, 1e-11)
        << round;
  }
}

// As a physicist had it: bars that slide all the while, for which all laws of restitution are one, left at
// none of the half of their speed that they were to have, or at all of it.
TEST(CornerImpact, OfABarThatSlidesGivesBackHalfItsSpeed) {
  for (const double dt : {1.0 / 60.0, 0.01, 0.002}) {
    Trial run("time = { dt = " + std::to_string(dt) + ", until = 1 }\n" + material(0.5, 1.0) +
              "[shapes]\nbar = { polygon = [[-1, -0.05], [1, -0.05], [1, 0.05], [-1, 0.05]] }\n"
              "[[bodies]]\nshape = 'bar'\nat = [0, 0.7]\nangle = -0.523\nvelocity = [2.72, -2.59]\n"
              "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n");
    while (run.state.spin[0] == 0.0) run.steps(1);
    const Vec corner = narrowphase::pose({0, 0}, run.state.angle[0]).rotate(Vec(1, -0.05));
    EXPECT_NEAR(run.state.velocity[0].y() + run.state.spin[0] * corner.x(), 0.5 * 2.59, 0.03 * 2.59) << dt;
    const Vec impulse = run.state.velocity[0] - Vec(2.72, -2.59);
    EXPECT_NEAR(impulse.x(), -impulse.y(), 1e-12) << "it slides, " << dt;
  }
}

}  // namespace
}  // namespace throng
