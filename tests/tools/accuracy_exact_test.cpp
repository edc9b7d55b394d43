// SPDX-License-Identifier: MIT
// What the laboratory calls exact, held against what it was not made from: energy, momentum, limits.
#include <gtest/gtest.h>

#include <cmath>

#include "tools/bench/accuracy/exact_billiard.h"
#include "tools/bench/accuracy/exact_bounce.h"
#include "tools/bench/accuracy/exact_gas.h"
#include "tools/bench/accuracy/exact_impact.h"
#include "tools/bench/accuracy/exact_incline.h"
#include "tools/bench/accuracy/exact_row.h"
#include "tools/bench/accuracy/exact_spring.h"
#include "tools/bench/accuracy/exact_throw.h"

namespace throng::bench {
namespace {

const Vec kGravity(0.0, -9.81);
const Vec kSlope(9.81 * 0.5, -9.81 * std::sqrt(0.75));  // of 30 degrees

/// The rate at which f changes, by differences.
template <class F>
double rate(F f, double t) {
  return (f(t + 1e-6) - f(t - 1e-6)) / 2e-6;
}

TEST(ExactThrow, KeepsItsEnergyAndMovesAsItsVelocitySays) {
  const BodyState start{{1.0, 2.0}, 0.1, {3.0, 4.0}, 5.0};
  const auto energy = [](const BodyState& b) {
    return 0.5 * b.velocity.squaredNorm() + 9.81 * b.position.y();
  };
  const BodyState later = exact_throw(start, kGravity, 1.7);
  EXPECT_NEAR(energy(later), energy(start), 1e-12);
  EXPECT_DOUBLE_EQ(later.angle, 0.1 + 8.5);
  EXPECT_NEAR(rate([&](double t) { return exact_throw(start, kGravity, t).position.y(); }, 1.7),
              later.velocity.y(), 1e-7);
}

TEST(ExactBounce, RisesEachTimeToTheSquareOfTheRestitutionUntilItRests) {
  const double fall = std::sqrt(2.0 / 9.81);
  double top = 0.0;  // s
  for (int n = 1; n < 6; ++n) {
    top += std::pow(0.8, n - 1) * fall + std::pow(0.8, n) * fall;
    EXPECT_NEAR(exact_bounce(1.0, 9.81, 0.8, top).height, std::pow(0.8, 2 * n), 1e-12) << "bounce " << n;
    EXPECT_NEAR(exact_bounce(1.0, 9.81, 0.8, top).speed, 0.0, 1e-12);
  }
  EXPECT_NEAR(exact_rest(1.0, 9.81, 0.8), 4.063713, 1e-6) << "s";
  EXPECT_NEAR(exact_rest(1.0, 9.81, 0.5), 1.354571, 1e-6) << "s";
  EXPECT_EQ(exact_bounce(1.0, 9.81, 0.8, 4.0638).height, 0.0);
  EXPECT_LT(exact_bounce(1.0, 9.81, 0.8, 4.063).height, 1e-6) << "m";
}

TEST(ExactBounce, WithoutLossComesBackToWhereItBegan) {
  const double period = 2.0 * std::sqrt(2.0 / 9.81);
  EXPECT_NEAR(exact_bounce(1.0, 9.81, 1.0, 7 * period).height, 1.0, 1e-12);
}

TEST(ExactIncline, RollsWithoutSlipAndKeepsItsEnergy) {
  const BodyState start;
  const BodyState later = exact_incline(start, kSlope, 0.5, 0.5, 2.0);
  EXPECT_NEAR(later.velocity.x() + 0.5 * later.spin, 0.0, 1e-14) << "slip";
  const double fallen = 0.5 * later.position.x();  // m: the sine of 30 degrees
  EXPECT_NEAR(0.5 * std::pow(later.velocity.x(), 2) + 0.25 * std::pow(0.5 * later.spin, 2), 9.81 * fallen,
              1e-12)
      << "J/kg, of moving and of turning";
}

TEST(ExactIncline, SlipsWhereFrictionIsTooSmallToRoll) {
  const double least = std::tan(M_PI / 6) / 3;
  for (const double friction : {0.0, 0.1, least - 1e-6, least + 1e-6}) {
    const BodyState later = exact_incline({}, kSlope, friction, 0.5, 1.0);
    EXPECT_EQ(later.velocity.x() + 0.5 * later.spin > 1e-9, friction < least) << friction;
  }
  EXPECT_NEAR(exact_incline({}, kSlope, 0.0, 0.5, 2.0).position.x(), 9.81, 1e-12) << "m, without friction";
}

TEST(ExactIncline, OnTheFlatRollsAtTwoThirdsOfItsSpeed) {
  const BodyState start{{0.0, 0.5}, 0.0, {6.0, 0.0}, 0.0};
  const double rolls = 6.0 / (3.0 * 0.5 * 9.81);  // s
  EXPECT_NEAR(exact_incline(start, kGravity, 0.5, 0.5, rolls - 1e-9).velocity.x(), 4.0, 1e-7);
  EXPECT_DOUBLE_EQ(exact_incline(start, kGravity, 0.5, 0.5, 5.0).velocity.x(), 4.0);
  EXPECT_DOUBLE_EQ(exact_incline(start, kGravity, 0.5, 0.5, 5.0).spin, -8.0);
}

TEST(ExactIncline, IsTheSameMirrored) {
  const BodyState start{{0.0, 0.5}, 0.0, {4.0, 0.0}, 1.0}, mirrored{{0.0, 0.5}, 0.0, {-4.0, 0.0}, -1.0};
  const Vec other(-kSlope.x(), kSlope.y());
  for (const double t : {0.2, 0.5, 1.0, 2.0}) {
    const BodyState a = exact_incline(start, kSlope, 0.5, 0.5, t),
                    b = exact_incline(mirrored, other, 0.5, 0.5, t);
    EXPECT_EQ(a.position.x(), -b.position.x());
    EXPECT_EQ(a.angle, -b.angle);
  }
}

TEST(ExactSlide, StopsWhereItsEnergyIsSpent) {
  const BodyState start{{0.0, 0.0}, 0.0, {5.0, 0.0}, 0.0};
  EXPECT_NEAR(exact_slide(start, kGravity, 0.5, 9.0).position.x(), 25.0 / (2.0 * 0.5 * 9.81), 1e-14);
  EXPECT_EQ(exact_slide(start, kGravity, 0.5, 9.0).velocity.x(), 0.0);
  EXPECT_NEAR(exact_slide({}, kSlope, 0.1, 2.0).velocity.x(), 2.0 * 9.81 * (0.5 - 0.1 * std::sqrt(0.75)),
              1e-12);
  EXPECT_EQ(exact_slide({}, kSlope, 0.6, 2.0).velocity.x(), 0.0) << "steeper than friction holds";
}

std::array<RigidDisc, 2> oblique() {
  return {
      {{{{0.0, 0.0}, 0.0, {2.0, 0.1}, 3.0}, 0.5, 0.8}, {{{2.2, 0.35}, 0.0, {-0.3, 0.0}, -1.0}, 0.4, 0.5}}};
}

double kinetic(const std::array<RigidDisc, 2>& discs, const std::array<BodyState, 2>& now) {
  double sum = 0.0;
  for (const int i : {0, 1})
    sum += 0.5 * discs[i].mass * now[i].velocity.squaredNorm() +
           0.25 * discs[i].mass * std::pow(discs[i].radius * now[i].spin, 2);
  return sum;
}

/// About the origin.
double angular_momentum(const std::array<RigidDisc, 2>& discs, const std::array<BodyState, 2>& now) {
  double sum = 0.0;
  for (const int i : {0, 1}) {
    const Vec &x = now[i].position, &v = now[i].velocity;
    sum += discs[i].mass * (x.x() * v.y() - x.y() * v.x() + 0.5 * std::pow(discs[i].radius, 2) * now[i].spin);
  }
  return sum;
}

TEST(ExactImpact, KeepsMomentumAndAngularMomentum) {
  const auto discs = oblique();
  for (const double friction : {0.0, 0.1, 5.0}) {
    const auto before = exact_impact(discs, 0.6, friction, 0.0),
               after = exact_impact(discs, 0.6, friction, 2.0);
    const Vec change =
        0.8 * (after[0].velocity - before[0].velocity) + 0.5 * (after[1].velocity - before[1].velocity);
    EXPECT_LT(change.norm(), 1e-14);
    EXPECT_GT((after[0].velocity - before[0].velocity).norm(), 0.5) << "they met";
    EXPECT_NEAR(angular_momentum(discs, after), angular_momentum(discs, before), 1e-13);
    EXPECT_LE(kinetic(discs, after), kinetic(discs, before));
  }
}

TEST(ExactImpact, TurnsTheSpeedAlongTheNormalByTheRestitutionAndStopsTheSlipWhereFrictionCan) {
  const auto discs = oblique();
  const double met = meeting_time(discs[0], discs[1]);
  const auto touching = exact_impact(discs, 0.6, 5.0, met);
  const Vec normal = (touching[1].position - touching[0].position).normalized(),
            tangent(-normal.y(), normal.x());
  EXPECT_NEAR((touching[1].position - touching[0].position).norm(), 0.9, 1e-14) << "m";
  for (const double friction : {0.01, 5.0}) {
    const auto after = exact_impact(discs, 0.6, friction, met + 1e-9);
    const Vec speed = after[0].velocity - after[1].velocity;
    EXPECT_NEAR(speed.dot(normal), -0.6 * (touching[0].velocity - touching[1].velocity).dot(normal), 1e-12);
    const double slip = speed.dot(tangent) + 0.5 * after[0].spin + 0.4 * after[1].spin;
    EXPECT_EQ(std::abs(slip) < 1e-12, friction > 1.0);
  }
  EXPECT_NEAR(kinetic(discs, exact_impact(discs, 1.0, 0.0, 2.0)), kinetic(discs, touching), 1e-13)
      << "no loss";
}

TEST(ExactRow, HandsTheSpeedThroughTheRow) {
  const BodyState row[] = {{{0.0, 0.0}, 0.0, {2.0, 0.0}, 0.0},
                           {{2.03, 0.0}, 0.0, {0.0, 0.0}, 0.0},
                           {{3.08, 0.0}, 0.0, {0.0, 0.0}, 0.0}};
  const auto later = exact_row(row, 1.0, 1.0);
  EXPECT_NEAR(later[0].position.x(), 1.03, 1e-15) << "m: where it touched the second";
  EXPECT_NEAR(later[1].position.x(), 2.08, 1e-15) << "m: where that touched the third";
  EXPECT_NEAR(later[2].position.x(), 2.0 + 2.0, 1e-15) << "m: as if it had flown through two diameters";
  EXPECT_EQ(later[2].velocity.x(), 2.0);
}

TEST(ExactBilliard, ComesBackAfterItsPeriod) {
  const BodyState start{{0.4, 0.3}, 0.0, {1.3, 0.7}, 0.0};
  const Table table{{0.05, 0.05}, {1.95, 0.95}};
  EXPECT_NEAR(exact_billiard(start, table, 2.0 * 1.9 / 1.3).position.x(), 0.4, 1e-14);
  EXPECT_NEAR(exact_billiard(start, table, 2.0 * 0.9 / 0.7).position.y(), 0.3, 1e-14);
  for (double t = 0.0; t < 20.0; t += 0.37) {
    const Vec p = exact_billiard(start, table, t).position;
    EXPECT_TRUE((p.array() >= table.min.array()).all() && (p.array() <= table.max.array()).all()) << t;
  }
}

TEST(ExactBilliard, IsUnfoldedAsItIsReflected) {
  const BodyState start{{0.4, 0.3}, 0.0, {1.3, 0.7}, 0.0};
  const Table plain{{0.05, 0.05}, {1.95, 0.95}},
      out_of_the_way{{0.05, 0.05}, {1.95, 0.95}, {50.0, 50.0}, 0.1};
  for (double t = 0.0; t < 20.0; t += 0.37) {
    const BodyState a = exact_billiard(start, plain, t), b = exact_billiard(start, out_of_the_way, t);
    EXPECT_LT((a.position - b.position).norm(), 1e-13) << t;
    EXPECT_EQ(a.velocity, b.velocity) << t;
  }
}

TEST(ExactBilliard, NeverEntersThePostKeepsItsSpeedAndRetracesItsWay) {
  const BodyState start{{0.3, 0.45}, 0.0, {1.1, 0.6}, 0.0};
  const Table table{{0.05, 0.05}, {1.95, 1.95}, {1.0, 1.0}, 0.45};
  double nearest = 9.0;
  for (double t = 0.0; t < 5.0; t += 0.01)
    nearest = std::min(nearest, (exact_billiard(start, table, t).position - table.post).norm());
  EXPECT_GE(nearest, 0.45 - 1e-12);
  EXPECT_LT(nearest, 0.46) << "it gets to the post";
  BodyState back = exact_billiard(start, table, 5.0);
  EXPECT_NEAR(back.velocity.norm(), start.velocity.norm(), 1e-14);
  back.velocity = -back.velocity;
  EXPECT_LT((exact_billiard(back, table, 5.0).position - start.position).norm(), 1e-11) << "m";
}

TEST(ExactGas, HasTheVirialSeriesOfHardDiscsAndWhatSimulationsFound) {
  constexpr double kVirial[] = {1.0, 2.0, 3.12802, 4.25785, 5.33690, 6.36303, 7.35208};  // Clisby, McCoy 2006
  for (const double fraction : {0.01, 0.05, 0.1, 0.15}) {
    double series = 0.0;
    for (int n = 6; n >= 0; --n) series = series * fraction + kVirial[n];
    EXPECT_NEAR(exact_compressibility(fraction) / series, 1.0, 2e-4) << fraction;
  }
  EXPECT_NEAR(exact_compressibility(0.3), 2.063, 0.001 * 2.063) << "10^7 collisions of 1,024 discs";
  EXPECT_NEAR(exact_compressibility(0.5), 4.106, 0.001 * 4.106);
}

TEST(ExactGas, CollidesAtTheRateOfBoltzmannWhereItIsThin) {
  const double fraction = 1e-6, diameter = 0.2, square = 3.0;            // m, m²/s²
  const double number = fraction / (0.25 * M_PI * diameter * diameter);  // 1/m²
  EXPECT_NEAR(exact_collision_rate(fraction, diameter, square),
              2.0 * number * diameter * std::sqrt(M_PI * square / 2.0), 1e-9);
}

/// Newton's law in a million small steps, from touch to the end of the overlap.
TEST(ExactSpring, IsTheOscillationOfItsEquation) {
  const double k = 2e4, m = 0.3;
  for (const double e : {0.2, 0.7, 1.0}) {
    const double damping = exact_damping(k, m, e), h = 1e-8;
    double depth = 0.0, speed = 1.0, time = 0.0;
    do {
      const double half = speed - 0.5 * h * (k * depth + damping * speed) / m;
      depth += h * half;
      speed -= h * (k * depth + damping * half) / m;
      time += h;
    } while (depth > 0.0);
    const SpringImpact exact = exact_spring_impact(k, m, damping);
    EXPECT_NEAR(exact.restitution, e, 1e-14);
    EXPECT_NEAR(-speed, e, 1e-4);
    EXPECT_NEAR(time / exact.duration, 1.0, 1e-4);
  }
}

}  // namespace
}  // namespace throng::bench
