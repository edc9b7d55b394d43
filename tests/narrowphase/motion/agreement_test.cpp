// SPDX-License-Identifier: MIT
// Bisection, first contact of shapes and of hierarchies, and the algebraic answer: one truth, four ways to
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "moving_shapes.h"
#include "moving_solids.h"
#include "narrowphase/motion/baselines/advance_scalar.h"
#include "narrowphase/motion/baselines/algebraic.h"
#include "narrowphase/motion/check_motion.h"
#include "narrowphase/motion/first_contact_parts.h"

namespace throng::narrowphase {
namespace {

struct Answers {
  FirstContact shapes, parts, algebraic;
  PathAnswer bisection;
};

Answers all_answers(const MovingPairOfShapes& p) {
  const PartsBvh a = parts_bvh({&p.a, 1}), b = parts_bvh({&p.b, 1});
  return {first_contact(p.a, p.motion_a, p.b, p.motion_b, 1.0),
          first_contact(a, p.motion_a, b, p.motion_b, 1.0).contact,
          algebraic_contact(p.a, p.motion_a, p.b, p.motion_b, 1.0),
          check_motion(a, p.motion_a, b, p.motion_b, 1.0)};
}

void expect_agreement(const MovingPairOfShapes& p, const Answers& answers) {
  ASSERT_NE(answers.shapes.verdict, Verdict::undecided);
  expect_same_contact(answers.parts, answers.shapes, 0.0);
  expect_same_contact(answers.algebraic, answers.shapes, 0.0);
  const PathAnswer& found = answers.bisection;
  EXPECT_EQ(found.verdict, answers.shapes.verdict);
  if (found.verdict != Verdict::hit) return;
  EXPECT_GE(found.from, answers.shapes.t_lo) << "no hit comes before the first";
  EXPECT_LE(separation(p.a, pose_at(p.motion_a, found.from), p.b, pose_at(p.motion_b, found.from)).distance,
            0.0);
}

void expect_same(const Answers& found, const Answers& expected, double tolerance) {
  expect_same_contact(found.shapes, expected.shapes, tolerance);
  expect_same_contact(found.parts, expected.parts, tolerance);
  expect_same_contact(found.algebraic, expected.algebraic, tolerance);
  EXPECT_EQ(found.bisection.verdict, expected.bisection.verdict);
}

/// Backwards the first contact is the last one: all four say the same of it, and it isn't before the first.
void expect_reversible(const MovingPairOfShapes& p, const Answers& forwards) {
  const MovingPairOfShapes q{p.a, p.b, reversed(p.motion_a, 1.0), reversed(p.motion_b, 1.0)};
  const Answers backwards = all_answers(q);
  expect_agreement(q, backwards);
  EXPECT_EQ(backwards.shapes.verdict, forwards.shapes.verdict);
  if (backwards.shapes.verdict == Verdict::hit) {
    EXPECT_LE(forwards.shapes.t_lo, 1.0 - backwards.shapes.t_lo + 1e-15);
  }
}

TEST(Agreement, OfAllFourOnEveryPathSwappedReversedAndMoved) {
  Random random(20261123);
  constexpr int kPairs = 3000;
  int hits = 0;
  for (int i = 0; i < kPairs; ++i) {
    SCOPED_TRACE("seed 20261123, pair " + std::to_string(i));
    const MovingPairOfShapes p = random_motions(random);
    const Answers answers = all_answers(p);
    hits += answers.shapes.verdict == Verdict::hit;
    expect_agreement(p, answers);
    expect_same(all_answers({p.b, p.a, p.motion_b, p.motion_a}), answers, 0.0);
    expect_reversible(p, answers);
    const double angle = uniform(random, -4.0, 4.0);
    const Vec shift = random_vec(random, 100.0, 100.0);
    expect_same(all_answers({p.a, p.b, moved(p.motion_a, angle, shift), moved(p.motion_b, angle, shift)}),
                answers, 1e-10);
    if (HasFailure()) return;
  }
  std::printf("seed 20261123: %d of %d hit\n", hits, kPairs);
  EXPECT_GT(hits, 3 * kPairs / 10);
  EXPECT_LT(hits, 7 * kPairs / 10);
}

/// That two meet is known after a fifth of the distances that published advancement computes on its way to
/// the first contact, by the median: of rods 2 m long, which are hard to hit upon.
TEST(Agreement, AHitIsKnownAfterAFifthOfWhatAdvancementTakes) {
  const Convex rod = convex({{-1, -0.01}, {1, -0.01}, {1, 0.01}, {-1, 0.01}});
  const PartsBvh solid = parts_bvh({&rod, 1});
  ContactQuestion to_a_millionth;
  to_a_millionth.width = 1e-6;
  Random random(20261123);
  std::vector<double> shares;
  for (int i = 0; i < 1000; ++i) {
    MovingPairOfShapes p = random_motions(random);
    const PathAnswer hit = check_motion(solid, p.motion_a, solid, p.motion_b, 1.0);
    if (hit.verdict != Verdict::hit) continue;
    const FirstContact first =
        advance_scalar(rod, p.motion_a, rod, p.motion_b, 1.0, Closing::directional, to_a_millionth);
    if (first.t_lo > 0.0) shares.push_back(static_cast<double>(hit.evaluations) / first.evaluations);
  }
  ASSERT_GT(shares.size(), 300u) << "seed 20261123";
  std::nth_element(shares.begin(), shares.begin() + shares.size() / 2, shares.end());
  EXPECT_LE(shares[shares.size() / 2], 0.2);
  std::printf("seed 20261123: of %zu hits, %.3f of the distances by the median\n", shares.size(),
              shares[shares.size() / 2]);
}

}  // namespace
}  // namespace throng::narrowphase
