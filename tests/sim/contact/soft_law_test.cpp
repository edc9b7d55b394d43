// SPDX-License-Identifier: MIT
// Forces of soft contacts, against their definition and against the formulas of one impact.
#include "sim/contact/soft_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/trial.h"

namespace throng {
namespace {

/// The force at every moment of the way from `depth` - h closing / 2 to `depth` + h closing / 2, added up.
template <class Force>
SoftMean added_up(double depth, double closing, double h, Force force) {
  constexpr int kParts = 200'000;
  SoftMean sum;
  for (int i = 0; i < kParts; ++i) {
    const double now = depth + h * closing * ((i + 0.5) / kParts - 0.5);
    if (now > 0.0) sum.normal += force(now) / kParts, sum.share += 1.0 / kParts;
  }
  return sum;
}

TEST(SoftLaw, ForcesAreMeansOverTheStep) {
  const SoftPair pair{3.0, 0.7, 0.0};
  for (const double depth : {-0.4, -0.1, 0.0, 0.001, 0.1, 0.4, 0.9})
    for (const double closing : {-1.5, -0.2, 1e-3, 0.3, 2.0}) {
      SCOPED_TRACE(std::to_string(depth) + ", " + std::to_string(closing));
      const SoftMean line = LinearLaw{{1.0, 1.0}}.mean(pair, depth, closing, 0.7);
      const SoftMean line_sum =
          added_up(depth, closing, 0.7, [&](double d) { return 3.0 * d + 0.7 * closing; });
      EXPECT_NEAR(line.normal, line_sum.normal, 2e-5);
      EXPECT_NEAR(line.share, line_sum.share, 1e-5);
      const SoftMean hertz = HertzLaw{{1.0, 1.0}}.mean(pair, depth, closing, 0.7);
      const SoftMean hertz_sum = added_up(depth, closing, 0.7, [&](double d) {
        return 3.0 * std::pow(d, 1.5) + 0.7 * std::pow(d, 0.25) * closing;
      });
      EXPECT_NEAR(hertz.normal, hertz_sum.normal, 2e-5);
      EXPECT_NEAR(hertz.share, hertz_sum.share, 1e-5);
    }
}

TEST(SoftLaw, TangentialForceIsASpringAndADashpotUpToFriction) {
  const LinearLaw law{{0.5, 0.25}};
  const SoftPair pair{100.0, 4.0, 0.3, 0.1, 0.2};
  SoftSprings springs{0.01, 0.02};
  const SoftForce held = soft_force(law, pair, {0.5, 0.0, 0.1, 0.3}, 1e-3, true, springs);
  EXPECT_NEAR(held.normal, 50.0, 1e-12);
  EXPECT_NEAR(held.tangent, -(50.0 * 0.01 + 1.0 * 0.1), 1e-12);
  EXPECT_NEAR(held.torque, -(50.0 * 0.04 * 0.02 + 1.0 * 0.04 * 0.3), 1e-12);
  EXPECT_EQ(springs.slip, 0.01);
  springs = {1.0, -1.0};
  const SoftForce slips = soft_force(law, pair, {0.5, 0.0, 0.1, 0.3}, 1e-3, true, springs);
  EXPECT_NEAR(slips.tangent, -0.3 * 50.0, 1e-12);
  EXPECT_NEAR(slips.torque, 0.1 * 0.2 * 50.0, 1e-12);
  EXPECT_NEAR(50.0 * springs.slip + 1.0 * 0.1, 15.0, 1e-12) << "what is left holds just as much";
  EXPECT_NEAR(50.0 * 0.04 * springs.roll + 0.04 * 0.3, -1.0, 1e-12);
  EXPECT_EQ(soft_force(law, pair, {-0.5, 0.0, 0.1, 0.3}, 1e-3, true, springs).normal, 0.0);
}

TEST(SoftLaw, DampingRatioGivesTheRestitutionOfTheDampedOscillator) {
  for (const double e : {0.01, 0.1, 0.5, 0.9, 0.999}) {
    const double ratio = damping_ratio(e);
    EXPECT_NEAR(std::exp(-std::numbers::pi * ratio / std::sqrt(1.0 - ratio * ratio)), e, 1e-14);
  }
  EXPECT_EQ(damping_ratio(1.0), 0.0);
  EXPECT_EQ(damping_ratio(0.0), 1.0);
  EXPECT_LE(damping_ratio(1e-310), 1.0);
}

std::string hertz(double modulus) {
  return "contact = { model = \"hertz\", youngs_modulus = " + std::to_string(modulus) + " }\n";
}

/// Two discs of 1 kg that meet head on at 2 m/s, `steps` substeps in the duration of an elastic impact.
struct Impact {
  Impact(const std::string& model, double e, double steps, double phase) {
    scene =
        scene_from(model +
                   "time = { dt = 1e-9, until = 1, substeps = 1 }\n[materials.default]\nfriction = 0\n"
                   "density = " +
                   std::to_string(1.0 / (std::numbers::pi * 0.25)) + "\nrestitution = " + std::to_string(e) +
                   "\n" + kDisc + ball(0, 0, 1, 0) + ball(3, 0, -1, 0));
    const SoftPair pair = soft_pair(scene, 0.5, 0.25, damping_ratio(e));
    duration = contact_duration(scene, pair, 0.5, 2.0);
    scene.time.dt = duration / steps;
    scene.bodies.position[1].x() = 1.0 + 2.0 * scene.time.dt * (3.0 + phase);
  }

  /// Runs until they are apart; the speed at which they part over that at which they met.
  double restitution() {
    Trial trial(scene);
    bool met = false;
    for (int i = 0; i < 100'000; ++i) {
      trial.steps(1);
      const double gap = trial.state.position[1].x() - trial.state.position[0].x() - 1.0;
      most_overlap = std::max(most_overlap, -gap);
      lasted += gap < 0.0 ? scene.time.dt : 0.0;
      met = met || gap < 0.0;
      if (met && gap > 2.0 * scene.time.dt) break;
    }
    EXPECT_TRUE(met);
    return 0.5 * (trial.state.velocity[1].x() - trial.state.velocity[0].x());
  }

  Scene scene;
  double duration = 0.0, most_overlap = 0.0, lasted = 0.0;  // s, m, s
};

/// The largest error of the restitution over where in a step they meet, of it.
double error(const std::string& model, double e, double steps) {
  double worst = 0.0;
  for (int i = 0; i < 8; ++i)
    worst = std::max(worst, std::abs(Impact(model, e, steps, i / 8.0 + 0.03).restitution() / e - 1.0));
  return worst;
}

TEST(SoftImpact, RestitutionIsThatOfTheMaterialWithinAThousandthAtFiftyStepsAContact) {
  for (const double e : {0.3, 0.5, 0.8, 0.9, 1.0}) {
    EXPECT_LT(error(spring(1e6), e, 50), 1e-3) << e;
    EXPECT_LT(error(hertz(1e8), e, 50), 1e-3) << e;
  }
}

TEST(SoftImpact, ErrorsFallWithTheSquareOfTheStep) {
  for (const double e : {0.3, 0.5, 0.8}) {
    for (const std::string& model : {spring(1e6), hertz(1e8)}) {
      const double coarse = error(model, e, 50), fine = error(model, e, 400);
      EXPECT_NEAR(std::log2(coarse / fine) / 3.0, 2.0, 0.2) << model << e << ": " << coarse << ", " << fine;
    }
  }
}

TEST(SoftImpact, ElasticDiscsKeepTheirEnergy) {
  EXPECT_LT(error(spring(1e6), 1.0, 50), 1e-6);
  EXPECT_LT(error(hertz(1e8), 1.0, 50), 1e-6);
}

TEST(SoftImpact, LastsAndGetsAsDeepAsTheFormulasSay) {
  const double k = 1e6, m = 0.5;
  Impact elastic(spring(k), 1.0, 1000, 0.5);
  elastic.restitution();
  EXPECT_NEAR(elastic.lasted, std::numbers::pi * std::sqrt(m / k), 2.0 * elastic.scene.time.dt);
  EXPECT_NEAR(elastic.most_overlap / (2.0 * std::sqrt(m / k)), 1.0, 1e-5);
  Impact damped(spring(k), 0.5, 1000, 0.5);
  damped.restitution();
  const double ratio = damping_ratio(0.5);
  EXPECT_NEAR(damped.lasted, std::numbers::pi * std::sqrt(m / k / (1.0 - ratio * ratio)),
              2.0 * damped.scene.time.dt);
  Impact round(hertz(1e8), 1.0, 1000, 0.5);
  round.restitution();
  // LAMMPS' and the field's form: 2.868 (m*^2 / (R* E*^2 v))^(1/5), R* = R / 2, E* = E / (2 (1 - nu^2)).
  const double modulus = 0.5e8 / (1.0 - 0.09);
  const double formula = 2.868 * std::pow(m * m / (0.25 * modulus * modulus * 2.0), 0.2);
  EXPECT_NEAR(round.duration / formula, 1.0, 1e-4);
  EXPECT_NEAR(round.lasted, round.duration, 2.0 * round.scene.time.dt);
}

TEST(SoftImpact, WithoutRestitutionNobodyIsThrownBack) {
  Impact dead(spring(1e6), 0.0, 50, 0.3);
  Trial trial(dead.scene);
  trial.steps(2000);
  EXPECT_NEAR(trial.state.velocity[1].x() - trial.state.velocity[0].x(), 0.0, 1e-9);
}

}  // namespace
}  // namespace throng
