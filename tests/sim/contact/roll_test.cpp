// SPDX-License-Identifier: MIT
// Rolling resistance against the closed forms of a disc that rolls without slipping.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/trial.h"

namespace throng {
namespace {

constexpr double kRadius = 0.5;

/// A plane that is turned by `angle`, gravity straight down; the disc stands on it at the origin.
std::string incline(double angle, double resistance, double speed, const std::string& more = "") {
  std::ostringstream out;
  out.precision(17);
  const double c = std::cos(angle), s = std::sin(angle);
  out << "sleep = false\ngravity = [0, -9.81]\ntime = { dt = 0.005 }\n"
      << "[materials.default]\nfriction = 0.9\nrolling_resistance = " << resistance << "\n"
      << kDisc << "[[walls]]\nsegment = [[" << -100 * c << ", " << -100 * s << "], [" << 100 * c << ", "
      << 100 * s << "]]\n[[bodies]]\nshape = \"ball\"\nat = [" << -kRadius * s << ", " << kRadius * c
      << "]\nvelocity = [" << speed * c << ", " << speed * s << "]\nspin = " << -speed / kRadius << "\n"
      << more;
  return out.str();
}

double along(const Trial& trial, double angle) {
  return trial.state.velocity[0].dot(Vec(std::cos(angle), std::sin(angle)));
}

TEST(Rolling, IsSlowedByTwoThirdsOfTheCoefficient) {
  Trial trial(incline(0.0, 0.1, 3.0));
  trial.steps(200);
  // m a = -F, and the contact's torque F R - c R m g = -I a / R, I = m R^2 / 2
  EXPECT_NEAR(along(trial, 0.0), 3.0 - 2.0 / 3.0 * 0.1 * kG * 1.0, 2e-3);
  EXPECT_NEAR(trial.state.spin[0], -along(trial, 0.0) / kRadius, 1e-4);
}

TEST(Rolling, EndsAndStaysAtRest) {
  Trial trial(incline(0.0, 0.1, 1.0));
  trial.steps(1200);  // it rises again by most of what it sank, as its contact learns what it bears
  const Vec place = trial.state.position[0];
  EXPECT_NEAR(place.x(), 1.0 / (2.0 * 2.0 / 3.0 * 0.1 * kG), 0.01);
  trial.steps(400);
  EXPECT_LT((trial.state.position[0] - place).norm(), 1e-9);
}

TEST(Rolling, HoldsOnASlopeBelowTheCoefficient) {
  Trial trial(incline(std::atan(0.09), 0.1, 0.0));
  trial.steps(200);
  const Vec place = trial.state.position[0];
  trial.steps(1000);
  EXPECT_LT((trial.state.position[0] - place).norm(), 1e-6);
  EXPECT_LT(std::abs(along(trial, std::atan(0.09))), 1e-6);
}

TEST(Rolling, GoesDownASlopeAboveItAtTheRestOfGravity) {
  const double angle = -std::atan(0.2);
  Trial trial(incline(angle, 0.1, 0.0));
  trial.steps(200);
  const double expected = 2.0 / 3.0 * kG * (std::sin(-angle) - 0.1 * std::cos(angle)) * 1.0;
  EXPECT_NEAR(along(trial, angle), expected, 5e-3 * expected);
}

TEST(Rolling, OfTwoDiscsHasTheirEffectiveRadius) {
  const std::string text =
      "gravity = [0, 0]\n[materials.default]\nfriction = 0\nrolling_resistance = 0.2\n"
      "[shapes]\nball = { disc = { radius = 0.5 } }\n[[bodies]]\nshape = \"ball\"\nat = [0, 0]\nspin = 4\n"
      "velocity = [0.5, 0]\n[[bodies]]\nshape = \"ball\"\nat = [1, 0]\nvelocity = [-0.5, 0]\n";
  Trial trial(text);
  const double mass = throng::mass(trial.scene, 0), inertia = throng::inertia(trial.scene, 0);
  trial.steps(1);
  // They stop each other: the normal impulse is m v, the torque's c r s / (r + s) times that.
  const double turned = 0.2 * 0.25 * mass * 0.5 / inertia;
  EXPECT_NEAR(trial.state.spin[0], 4.0 - turned, 1e-9);
  EXPECT_NEAR(trial.state.spin[1], turned, 1e-9);
}

/// A disc that spins strikes a wall: the normal impulse is (1 + e) m v, the torque's that times coefficient
/// and radius, and never more than stops the disc.
TEST(Rolling, IsResistedInBouncesToo) {
  for (const double restitution : {0.0, 0.5, 1.0})
    for (const double coefficient : {0.1, 5.0}) {
      Trial trial("gravity = [0, 0]\n[materials.default]\nfriction = 0\nrestitution = " +
                  std::to_string(restitution) + "\nrolling_resistance = " + std::to_string(coefficient) +
                  "\n" + kDisc + ball(0, 0.51, 0, -3, 10) + "[[walls]]\nsegment = [[-5, 0], [5, 0]]\n");
      trial.steps(10);
      EXPECT_NEAR(trial.state.velocity[0].y(), 3.0 * restitution, 1e-9);
      const double torque = coefficient * kRadius * throng::mass(trial.scene, 0) * (1.0 + restitution) * 3.0;
      const double expected = std::max(0.0, 10.0 - torque / throng::inertia(trial.scene, 0));
      EXPECT_NEAR(trial.state.spin[0], expected, 1e-9) << restitution << ", " << coefficient;
    }
}

TEST(Rolling, OfTwoDiscsThatBounceHasTheirEffectiveRadius) {
  Trial trial(
      "gravity = [0, 0]\n[materials.default]\nfriction = 0\nrestitution = 0.5\nrolling_resistance = 0.2\n" +
      std::string(kDisc) + ball(0, 0, 0.5, 0, 4) + ball(1.01, 0, -0.5, 0));
  trial.steps(10);
  const double turned =
      0.2 * 0.25 * 1.5 * throng::mass(trial.scene, 0) * 0.5 / throng::inertia(trial.scene, 0);
  EXPECT_NEAR(trial.state.spin[0], 4.0 - turned, 1e-9);
  EXPECT_NEAR(trial.state.spin[1], turned, 1e-9);
}

TEST(Rolling, IsNothingToPolygonsAndCostsNothingWhereNoSurfaceResists) {
  Trial trial(incline(0.0, 0.0, 1.0));
  trial.steps(10);
  EXPECT_FALSE(trial.plan.rolling);
  EXPECT_TRUE(trial.work.contacts.point_rolls.empty());
  Trial box(
      "gravity = [0, -9.81]\n[materials.default]\nrolling_resistance = 0.3\n[shapes]\nbox = { polygon = [[0, "
      "0], [1, 0], [1, 1], [0, 1]] }\nball = { disc = { radius = 0.5 } }\n[[bodies]]\nshape = \"box\"\nat = "
      "[0, 0.5]\n[[walls]]\nsegment = [[-5, 0], [5, 0]]\n" +
      ball(100, 0, 0, 0));
  box.steps(10);
  EXPECT_EQ(box.state.point_contacts.size(), 2u);
  EXPECT_TRUE(box.plan.rolling);
  EXPECT_TRUE(box.work.contacts.point_rolls.empty());
}

/// The torque of the last step starts the next one: without it the disc would creep downhill.
TEST(Rolling, IsRememberedFromStepToStep) {
  const double angle = std::atan(0.09);
  Trial trial(incline(angle, 0.1, 0.0)), forgetful(incline(angle, 0.1, 0.0));
  for (int i = 0; i < 200; ++i) {
    trial.steps(1);
    forgetful.steps(1);
    for (ContactImpulse& contact : forgetful.state.point_contacts) contact.rolling = 0.0;
  }
  ASSERT_EQ(trial.state.point_contacts.size(), 1u);
  const double weight = throng::mass(trial.scene, 0) * kG * trial.plan.substep;
  EXPECT_NEAR(std::abs(trial.state.point_contacts[0].rolling), weight * std::sin(angle) * kRadius,
              1e-6 * weight);
  EXPECT_NE(trial.state.position[0], forgetful.state.position[0]);
}

}  // namespace
}  // namespace throng
