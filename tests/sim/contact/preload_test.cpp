// SPDX-License-Identifier: MIT
// What a contact has learnt to bear it bears without sinking.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/contact/solve.h"
#include "sim/overlap.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

constexpr double kLoad = 1.0;

TEST(Preload, IsLearntFromBelowAndForgottenAtOnce) {
  const Learning learn{0.5, 0.01, 0.1, 0.2, 1000.0};
  EXPECT_DOUBLE_EQ(learn(0.0, kLoad, 1.0, 0.0), 0.4);
  EXPECT_DOUBLE_EQ(learn(0.4, kLoad, 1.0, 0.0), 0.6);
  EXPECT_DOUBLE_EQ(learn(0.9, kLoad, 1.0, 0.0), 0.9);
  EXPECT_DOUBLE_EQ(learn(0.9, 0.5 * kLoad, 1.0, 0.0), 0.5 * kLoad);
  EXPECT_DOUBLE_EQ(learn(0.4, kLoad, 0.09, 0.0), 0.4);  // 1,100 times its own weight
  EXPECT_DOUBLE_EQ(learn(0.4, kLoad, 1.0, 0.099 * 0.099), 0.6);
  EXPECT_DOUBLE_EQ(learn(0.4, kLoad, 1.0, 0.101 * 0.101), 0.4);  // who passes by
}

TEST(Preload, IsLearntMoreSlowlyByTheSquareOfTheLayers) {
  const auto in = [](double layers) { return learning_in(layers, 0.02, 0.002, 6, 0.5); };
  EXPECT_DOUBLE_EQ(in(1.0).share, 6.0 / 60.0);
  EXPECT_DOUBLE_EQ(in(kFewLayers).share, 6.0 / 60.0);
  EXPECT_DOUBLE_EQ(in(55.0).share, 6.0 / 75.0);
  EXPECT_DOUBLE_EQ(in(110.0).share, 6.0 / 300.0);
  EXPECT_DOUBLE_EQ(in(220.0).share, 6.0 / 1200.0);
  for (const double layers : {1.0, 110.0}) EXPECT_DOUBLE_EQ(in(layers).most, 1000.0);
  EXPECT_DOUBLE_EQ(in(220.0).most, 4000.0);
  EXPECT_DOUBLE_EQ(in(220.0).slow, in(1.0).slow);
  EXPECT_DOUBLE_EQ(in(220.0).left, in(1.0).left);
}

/// A disc that has come down on the floor. What it would sink there: the spring's gravity over the square of
/// its frequency.
TEST(Preload, LeavesAFifthOfTheSag) {
  constexpr double dt = 0.01;
  constexpr int kSubsteps = 4;
  Trial trial("sleep = false\ngravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\n" +
              std::string(kDisc) +
              "[[walls]]\nsegment = [[-9, 0], [9, 0]]\n[[bodies]]\nshape = \"ball\"\nat = [0, 0.501]\n");
  const double h = dt / kSubsteps;
  const Softness soft = softness(0.18 / h, 20.0, h);
  const double sag = kG * h * soft.impulse_scale / (soft.mass_scale * soft.bias_rate);
  trial.steps(1000);
  EXPECT_NEAR(overlap(trial.scene, trial.state).max, 0.2 * sag, 0.002 * sag);
}

std::string box_at(double y, const std::string& more = "") {
  return "[[bodies]]\nshape = \"box\"\nat = [0, " + std::to_string(y) + "]\n" + more;
}

const char* const kSite =
    "sleep = false\ngravity = [0, -9.81]\ntime = { dt = 0.01, substeps = 4 }\n"
    "[shapes]\nbox = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] }\n[[walls]]\nsegment "
    "= [[-9, 0], [9, 0]]\n";

/// In boxes of 1 kg each face bears those above it, half with each corner.
TEST(FirstLoads, AreWhatATowerBears) {
  constexpr int kBoxes = 12;
  std::string text = kSite;
  for (int i = 0; i < kBoxes; ++i) text += box_at(0.5 + i);
  Trial trial(text);
  trial.steps(1);
  ASSERT_EQ(trial.state.point_contacts.size(), 2u * kBoxes);
  double sum = 0.0, most = 0.0;
  for (const ContactImpulse& contact : trial.state.point_contacts)
    sum += contact.preload, most = std::max(most, contact.preload);
  const double weight = kG * 0.0025;  // N s
  EXPECT_NEAR(most, 0.5 * kBoxes * weight, 0.005 * kBoxes * weight);
  EXPECT_NEAR(sum, 0.5 * kBoxes * (kBoxes + 1) * weight, 0.01 * sum);
  trial.steps(499);
  EXPECT_LT(overlap(trial.scene, trial.state).max, 2e-5);  // 1e-3 without
}

/// As one: no load that nothing bears drives them apart.
TEST(FirstLoads, AreNoneInATowerThatIsThrown) {
  std::string text = kSite;
  for (int i = 0; i < 12; ++i) text += box_at(0.5 + i, "velocity = [0, 2]\n");
  Trial trial(text);
  trial.steps(10);
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(trial.state.velocity[i].y(), 2.0 - 0.1 * kG, 1e-12) << i;
}

/// A floor that is taken away: they fall together.
TEST(FirstLoads, AreNoneOnAFloorThatMoves) {
  std::string text = kSite + box_at(4.5, "kind = \"kinematic\"\nvelocity = [0, -5]\n");
  for (int i = 0; i < 6; ++i) text += box_at(5.5 + i);
  Trial trial(text);
  trial.steps(5);
  for (int i = 1; i < 7; ++i) EXPECT_NEAR(trial.state.velocity[i].y(), -0.05 * kG, 1e-12) << i;
}

TEST(FirstLoads, LeaveWhoFliesAsHeFlies) {
  Trial trial(kSite + box_at(0.5, "velocity = [0.5, 1]\nspin = 0.25\n") + box_at(5.0));
  trial.steps(10);
  EXPECT_DOUBLE_EQ(trial.state.velocity[0].x(), 0.5);
  EXPECT_NEAR(trial.state.velocity[0].y(), 1.0 - 0.1 * kG, 1e-12);
  EXPECT_DOUBLE_EQ(trial.state.spin[0], 0.25);
  EXPECT_NEAR(trial.state.velocity[1].y(), -0.1 * kG, 1e-12);
}

/// Far below them, by more than a hundred layers.
TEST(Preload, IsLearntWhoeverFallsElsewhere) {
  std::string text = kSite;
  for (int i = 0; i < 5; ++i) text += box_at(0.505 + 1.01 * i);
  Trial alone(text), beside(text + "[[bodies]]\nshape = \"box\"\nat = [50, -200]\n");
  alone.steps(200), beside.steps(200);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(alone.state.position[i], beside.state.position[i]) << i;
  ASSERT_EQ(alone.state.point_contacts.size(), beside.state.point_contacts.size());
  for (std::size_t i = 0; i < alone.state.point_contacts.size(); ++i)
    EXPECT_EQ(alone.state.point_contacts[i].preload, beside.state.point_contacts[i].preload) << i;
}

/// What bears no load yet closes its gaps at once.
TEST(Preload, KeepsASpringThatHardlyOpens) {
  const SolverSettings settings{0.01, softness(18.0, 20.0, 0.01), Learning{}, 1.0, false, 1e-3};
  for (const bool loaded : {false, true})
    for (const double gap : {0.9e-3, 1.1e-3}) {
      std::vector<SolverBody> bodies(2);
      bodies[0].inverse_mass = 1.0;
      bodies[0].position = {0.0, 1.0 + gap};
      std::vector<DiscContact> contacts(1);
      DiscContact& contact = contacts[0];
      contact.a = 0, contact.b = 1, contact.normal_mass = 1.0, contact.radius_a = contact.radius_b = 0.5;
      contact.normal_impulse = kLoad, contact.preload = loaded ? kLoad : 0.0;
      prepare(contacts, bodies, nullptr);
      bodies[0].velocity = {0.0, 0.0};
      push_apart(contacts, bodies, settings);
      const bool spring = loaded && gap < settings.ajar;
      const Softness& soft = settings.softness;
      const double lets_go = spring ? soft.mass_scale * gap * soft.bias_rate : gap / settings.h;
      EXPECT_NEAR(contact.normal_impulse, kLoad - lets_go, 1e-12) << loaded << " " << gap;
    }
}

}  // namespace
}  // namespace throng
