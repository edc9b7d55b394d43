// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "exact_gap.h"
#include "moving_shapes.h"
#include "moving_solids.h"
#include "narrowphase/motion/first_contact.h"

namespace throng::narrowphase {
namespace {

FirstContact contact_of(const MovingPairOfShapes& p, double until = 1.0) {
  return first_contact(p.a, p.motion_a, p.b, p.motion_b, until);
}

double size(const MovingPairOfShapes& p) {
  double most = 0.0;
  for (const Convex* shape : {&p.a, &p.b})
    for (const Vec& v : shape->vertices) most = std::max(most, v.norm() + shape->radius);
  return most;
}

TEST(FirstContactExact, BracketsTheContactOfFiftyDigits) {
  Random random(20260202);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const MovingPairOfShapes p = random_motions(random);
    const FirstContact found = contact_of(p);
    if (found.verdict != Verdict::hit || found.t_lo == 0.0) continue;
    ++hits;
    const auto gap = [&](double t) { return exact_gap(p.a, p.motion_a, p.b, p.motion_b, t); };
    EXPECT_GT(gap(found.t_lo), 0) << "seed 20260202, pair " << i;
    EXPECT_GT(gap(found.t_lo * (1.0 - 1e-9)), 0) << "seed 20260202, pair " << i;
    EXPECT_LT(gap(found.t_hi), 0) << "seed 20260202, pair " << i;
    const double rate = gap_rate(p.motion_a, p.motion_b).of(size(p), size(p));
    EXPECT_LE((found.t_hi - found.t_lo) * rate, 1e-11 * size(p)) << "seed 20260202, pair " << i;
  }
  std::printf("seed 20260202: %d of 1000 hit on the way\n", hits);
  EXPECT_GT(hits, 300);
  EXPECT_LT(hits, 700);
}

TEST(FirstContactExact, IsTheSameWithTheShapesSwapped) {
  Random random(20260203);
  for (int i = 0; i < 2000; ++i) {
    const MovingPairOfShapes p = random_motions(random);
    expect_same_contact(contact_of({p.b, p.a, p.motion_b, p.motion_a}), contact_of(p), 0.0);
  }
}

/// The motion seen from elsewhere: turned by `pose`, then moved and moving.
Motion seen_from(const Motion& motion, const Pose& frame, double angle, const Vec& drift) {
  return {frame * motion.position, motion.angle + angle, frame.rotate(motion.velocity) + drift, motion.spin};
}

TEST(FirstContactExact, IsTheSameSeenFromElsewhere) {
  Random random(20260204);
  for (int i = 0; i < 2000; ++i) {
    MovingPairOfShapes p = random_motions(random);
    const FirstContact expected = contact_of(p);
    const double angle = uniform(random, -3.0, 3.0);
    const Pose frame = pose({1e6, -3e6}, angle);
    p.motion_a = seen_from(p.motion_a, frame, angle, {70.0, -30.0});
    p.motion_b = seen_from(p.motion_b, frame, angle, {70.0, -30.0});
    expect_same_contact(contact_of(p), expected, 1e-8);
  }
}

TEST(FirstContactExact, ScalesFromMillimetresToKilometres) {
  Random random(20260205);
  for (int i = 0; i < 2000; ++i) {
    const MovingPairOfShapes p = random_motions(random);
    const FirstContact expected = contact_of(p);
    for (const double factor : {0x1p-12, 0x1p12, 0x1p-300, 0x1p300, 0x1p-480, 0x1p480}) {
      SCOPED_TRACE(factor);
      MovingPairOfShapes q{scaled(p.a, factor), scaled(p.b, factor), p.motion_a, p.motion_b};
      for (Motion* motion : {&q.motion_a, &q.motion_b})
        motion->position *= factor, motion->velocity *= factor;
      expect_same_contact(contact_of(q), expected, 0.0);
    }
  }
}

TEST(FirstContactExact, OfAPathRunBackwardsIsThePathsWhereOnlyOneMomentTouches) {
  Random random(20260206);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const MovingPairOfShapes p = random_motions(random);
    const FirstContact found = contact_of(p);
    const double end = found.t_lo;  // free up to there: so is the way back
    if (end == 0.0) continue;
    const FirstContact back =
        contact_of({p.a, p.b, reversed(p.motion_a, end), reversed(p.motion_b, end)}, end);
    hits += found.verdict == Verdict::hit;
    // It begins as near to touching as rounding tells: then the first moment alone may be in doubt.
    EXPECT_TRUE(back.verdict == Verdict::free || back.t_hi < 1e-6) << "seed 20260206, pair " << i;
    EXPECT_TRUE(back.verdict == Verdict::free || found.verdict == Verdict::hit);
  }
  EXPECT_GT(hits, 600);
}

}  // namespace
}  // namespace throng::narrowphase
