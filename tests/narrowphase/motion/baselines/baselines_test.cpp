// SPDX-License-Identifier: MIT
// The baselines of first_contact: each is right where it says anything, and short of it where it must be.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>

#include "../moving_shapes.h"
#include "narrowphase/motion/baselines/algebraic.h"
#include "narrowphase/motion/baselines/interval_newton.h"
#include "narrowphase/motion/baselines/sampled.h"
#include "narrowphase/motion/baselines/swept_hull.h"

namespace throng::narrowphase {
namespace {

TEST(AlgebraicContact, AgreesWithAdvancement) {
  Random random(20260220);
  constexpr int kPairs = 5000;
  int hits = 0;
  double evaluations = 0.0;
  for (int i = 0; i < kPairs; ++i) {
    const MovingPairOfShapes p = random_motions(random);
    const FirstContact expected = first_contact(p.a, p.motion_a, p.b, p.motion_b, 1.0);
    const FirstContact found = algebraic_contact(p.a, p.motion_a, p.b, p.motion_b, 1.0);
    ASSERT_EQ(found.verdict, expected.verdict) << "seed 20260220, pair " << i;
    EXPECT_LE(found.t_lo, expected.t_hi) << "seed 20260220, pair " << i;
    EXPECT_GE(found.t_hi, expected.t_lo) << "seed 20260220, pair " << i;
    hits += expected.verdict == Verdict::hit, evaluations += found.evaluations;
  }
  std::printf("seed 20260220: %d of %d hit, %g evaluations each\n", hits, kPairs, evaluations / kPairs);
  EXPECT_GT(hits, 3 * kPairs / 10);
  EXPECT_LT(hits, 7 * kPairs / 10);
}

TEST(AlgebraicContact, OfATranslationTakesOneStepARoot) {
  const Convex square = convex({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const FirstContact found = algebraic_contact(square, {{0, 0}, 0, {3, 0}, 0}, square, {{2.5, 0.25}}, 1.0);
  EXPECT_EQ(found.verdict, Verdict::hit);
  EXPECT_LE(found.t_lo, 0.5);
  EXPECT_GE(found.t_hi, 0.5);
  EXPECT_LE(found.t_hi - found.t_lo, 1e-12);
  EXPECT_LE(found.evaluations, 32 * 4);
}

/// The corners of the one are on the other's ground line all the while, and off its edge until 2 s.
TEST(AlgebraicContact, OfSquaresOnOneGroundLineSkipsTheLineBesideTheEdge) {
  const Convex square = convex({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const FirstContact found = algebraic_contact(square, {}, square, {{3, 0}, 0, {-1, 0}, 0}, 5.0);
  EXPECT_NE(found.verdict, Verdict::free);
  EXPECT_NEAR(found.t_lo, 2.0, 1e-10);
  EXPECT_LE(found.t_lo, 2.0);
  EXPECT_LT(found.evaluations, 5000);
  const FirstContact beyond = algebraic_contact(square, {}, square, {{3, 0}, 0, {-1, 0}, 0}, 1.9);
  EXPECT_EQ(beyond.verdict, Verdict::free);
}

/// A function that is 0 everywhere, and whose roots count nowhere that could be shown.
TEST(FirstRoot, LeavesTheRestInDoubtWhereItsEvaluationsRunOut) {
  int asked = 0;
  const auto zero = [&](double) { return ++asked, SlopedValue{0.0, 0.0}; };
  const auto never = [](double, double half) { return half > 1e-9; };
  const auto root = first_root({0.0, 1.0}, {1.0, 1e-15, 1e-12, 500}, zero, never);
  ASSERT_TRUE(root.has_value());
  EXPECT_FALSE(root->certain);
  EXPECT_GT(root->span.from, 0.0);
  EXPECT_EQ(root->span.until, 1.0);
  EXPECT_EQ(asked, 500);
}

TEST(FirstRoot, IsTheFirstOfTheSineThatCounts) {
  const auto sine = [](double t) { return SlopedValue{std::sin(t), std::cos(t)}; };
  const RootQuestion question{1.0, 1e-15, 1e-12};
  const auto any = first_root({1.0, 20.0}, question, sine, [](double, double) { return true; });
  ASSERT_TRUE(any.has_value());
  EXPECT_LE(any->span.from, 3.1415926535897932);
  EXPECT_GE(any->span.until, 3.1415926535897931);
  EXPECT_LE(any->span.until - any->span.from, 1e-12);
  EXPECT_TRUE(any->certain);
  const auto later =
      first_root({1.0, 20.0}, question, sine, [](double t, double half) { return t + half > 5.0; });
  ASSERT_TRUE(later.has_value());
  EXPECT_NEAR(later->span.from, 6.283185307179586, 1e-12);
  EXPECT_FALSE(first_root({3.2, 6.2}, question, sine, [](double, double) { return true; }).has_value());
}

TEST(FirstRoot, DoubtsARootThatOnlyTouches) {
  const auto parabola = [](double t) { return SlopedValue{(t - 0.3) * (t - 0.3), 2.0 * (t - 0.3)}; };
  const auto root = first_root({0.0, 1.0}, {2.0, 1e-15, 1e-9}, parabola, [](double, double) { return true; });
  ASSERT_TRUE(root.has_value());
  EXPECT_FALSE(root->certain);
  EXPECT_NEAR(root->span.from, 0.3, 1e-7);
}

TEST(Sampled, AsksEveryInstantOnceInEitherOrder) {
  for (const std::uint32_t steps : {1u, 2u, 3u, 7u, 8u, 9u, 100u})
    for (const SampleOrder order : {SampleOrder::sequential, SampleOrder::bisection}) {
      std::multiset<double> asked;
      const SampledAnswer answer = sampled(1.0, steps, order, [&](double t) {
        asked.insert(std::round(t * steps));
        return false;
      });
      EXPECT_EQ(asked.size(), steps + 1) << steps;
      EXPECT_EQ(std::set(asked.begin(), asked.end()).size(), steps + 1) << steps;
      EXPECT_FALSE(answer.hit);
      EXPECT_EQ(answer.samples, static_cast<int>(steps) + 1);
    }
}

TEST(Sampled, FindsALongHitSoonByBisectionAndTheEarliestInSequence) {
  const auto hits = [](double t) { return t > 0.4 && t < 0.7; };
  const SampledAnswer early = sampled(1.0, 1000, SampleOrder::sequential, hits);
  EXPECT_NEAR(early.time, 0.401, 1e-12);
  EXPECT_EQ(early.samples, 402);
  const SampledAnswer soon = sampled(1.0, 1000, SampleOrder::bisection, hits);
  EXPECT_TRUE(hits(soon.time));
  EXPECT_LE(soon.samples, 4);
}

TEST(Sampled, StepsAreAsLongAsTheSpacing) {
  EXPECT_EQ(sample_steps(3.0, 2.0, 0.1), 60u);
  EXPECT_EQ(sample_steps(0.0, 2.0, 0.1), 1u);
  EXPECT_EQ(sample_steps(1e300, 2.0, 0.1), 1u << 30);
}

TEST(SweptHull, ThatIsApartNeverHidesAContact) {
  Random random(20260221);
  int apart = 0, free = 0;
  for (int i = 0; i < 20000; ++i) {
    const MovingPairOfShapes p = random_motions(random);
    for (const double duration : {0.1, 1.0}) {
      const FirstContact truth = first_contact(p.a, p.motion_a, p.b, p.motion_b, duration);
      const bool found = swept_hulls_are_apart(p.a, p.motion_a, p.b, p.motion_b, duration);
      EXPECT_TRUE(!found || truth.verdict == Verdict::free) << "seed 20260221, pair " << i;
      apart += found, free += truth.verdict == Verdict::free;
    }
  }
  std::printf("seed 20260221: %d of %d free ones shown\n", apart, free);
  EXPECT_GT(apart, free / 4);
}

TEST(SweptHull, IsPaddedByNoLessThanTheSagitta) {
  // A rod turns by 1 rad; a point waits where only the arc comes by, beyond the chord.
  const Convex rod = segment({0.9, 0}, {1, 0}), point = disc(1e-3);
  const Motion turning{{0, 0}, -0.5, {0, 0}, 1};
  EXPECT_EQ(first_contact(rod, turning, point, {{1.0005, 0}}, 1.0).verdict, Verdict::hit);
  EXPECT_FALSE(swept_hulls_are_apart(rod, turning, point, {{1.0005, 0}}, 1.0));
  EXPECT_TRUE(swept_hulls_are_apart(rod, turning, point, {{1.02, 0}}, 1.0));
}

}  // namespace
}  // namespace throng::narrowphase
