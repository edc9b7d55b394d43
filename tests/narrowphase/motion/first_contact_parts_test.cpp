// SPDX-License-Identifier: MIT
#include "narrowphase/motion/first_contact_parts-inl.h"

#include <gtest/gtest.h>

#include "moving_shapes.h"
#include "narrowphase/decompose.h"
#include "narrowphase/motion/baselines/advance_scalar.h"
#include "tests/narrowphase/polygons.h"

namespace throng::narrowphase {
namespace {

struct Solids {
  std::vector<Convex> a, b;
  Motion motion_a, motion_b;
};

/// A star-shaped polygon in parts, or discs.
std::vector<Convex> random_parts(Random& random, double scale) {
  std::vector<Convex> parts;
  if (random() % 3 == 0) {
    for (std::size_t n = 1 + random() % 5; parts.size() < n;) {
      const Vec centre = random_vec(random, scale, scale);
      parts.push_back(disc(uniform(random, 0.1, 0.5) * scale, centre));
    }
    return parts;
  }
  std::vector<Vec> outline = random_simple(random, 5 + static_cast<int>(random() % 12));
  for (Vec& v : outline) v *= scale;
  return decompose(clean(outline).vertices);
}

Solids random_solids(Random& random) {
  const MovingPairOfShapes p = random_motions(random);
  return {random_parts(random, 0.9), random_parts(random, 0.9), p.motion_a, p.motion_b};
}

/// All pairs of parts, one by one.
FirstContact definition(const Solids& s) {
  FirstContact first{Verdict::free, 1.0, 1.0, 0};
  for (const Convex& a : s.a)
    for (const Convex& b : s.b)
      if (const FirstContact one = first_contact(a, s.motion_a, b, s.motion_b, 1.0); one.t_lo < first.t_lo)
        first = one;
  return first;
}

TEST(FirstPartsContact, IsTheFirstOfAllPairsOfParts) {
  Random random(20260210);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Solids s = random_solids(random);
    const FirstContact expected = definition(s);
    const FirstPartsContact found =
        first_contact(parts_bvh(s.a), s.motion_a, parts_bvh(s.b), s.motion_b, 1.0);
    ASSERT_EQ(found.contact.verdict, expected.verdict) << "seed 20260210, pair " << i;
    EXPECT_LE(found.contact.t_lo, expected.t_hi) << "seed 20260210, pair " << i;
    EXPECT_LE(expected.t_lo, found.contact.t_hi) << "seed 20260210, pair " << i;
    if (expected.verdict != Verdict::hit) continue;
    ++hits;
    const FirstContact told =
        first_contact(s.a[found.part_a], s.motion_a, s.b[found.part_b], s.motion_b, 1.0);
    EXPECT_LE(told.t_lo, found.contact.t_hi) << "seed 20260210, pair " << i;
    EXPECT_LE(found.contact.t_hi - found.contact.t_lo, 1e-11) << "seed 20260210, pair " << i;
  }
  std::printf("seed 20260210: %d of 3000 hit\n", hits);
  EXPECT_GT(hits, 900);
  EXPECT_LT(hits, 2100);
}

FirstPartsContact contact(Verdict verdict, double t_lo, double t_hi, std::uint32_t part) {
  return {{verdict, t_lo, t_hi, 0}, part, 0};
}

/// Of both orders.
void expect_merged(const FirstPartsContact& x, const FirstPartsContact& y,
                   const FirstPartsContact& expected) {
  for (const FirstPartsContact& found : {merged(x, y), merged(y, x)}) {
    EXPECT_EQ(found.contact.verdict, expected.contact.verdict);
    EXPECT_EQ(found.contact.t_lo, expected.contact.t_lo);
    EXPECT_EQ(found.contact.t_hi, expected.contact.t_hi);
    EXPECT_EQ(found.part_a, expected.part_a);
  }
}

TEST(MergedContacts, AreTheEarlierOneInABracketAsNarrowAsBothKnow) {
  using enum Verdict;
  const FirstPartsContact early = contact(hit, 0.2, 0.5, 1), doubt = contact(undecided, 0.2, 0.5, 1);
  EXPECT_EQ(merged(contact(free, 1, 1, 0), early).part_a, 1u) << "whatever comes is better than none";
  expect_merged(early, contact(hit, 0.6, 0.7, 2), early);
  expect_merged(early, contact(hit, 0.3, 0.4, 2), contact(hit, 0.2, 0.4, 2));
  expect_merged(early, contact(hit, 0.3, 0.5, 2), early);
  expect_merged(early, contact(hit, 0.3, 0.6, 2), early);
  expect_merged(early, contact(undecided, 0.3, 0.4, 2), early);
  expect_merged(early, contact(undecided, 0.1, 0.15, 2), contact(undecided, 0.1, 0.15, 2));
  expect_merged(doubt, contact(hit, 0.6, 0.7, 2), doubt);
  expect_merged(doubt, contact(hit, 0.5, 0.7, 2), contact(hit, 0.2, 0.7, 2));
  expect_merged(doubt, contact(hit, 0.3, 0.4, 2), contact(hit, 0.2, 0.4, 2));
}

/// Of equal beginnings none is earlier: the first stands.
TEST(MergedContacts, OfEqualOnesAreTheFirst) {
  EXPECT_EQ(merged(contact(Verdict::hit, 0.2, 0.5, 1), contact(Verdict::hit, 0.2, 0.5, 2)).part_a, 1u);
}

/// However few: what it knows until then stands, and the contact is never outside.
TEST(FirstPartsContact, IsInDoubtFromWhereItsLooksAreSpent) {
  Random random(20260212);
  int undecided = 0, hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Solids s = random_solids(random);
    const FirstContact expected = definition(s);
    const PartsBvh a = parts_bvh(s.a), b = parts_bvh(s.b);
    double known = 0.0;
    for (int looks = 0; looks <= 64; looks = looks < 8 ? looks + 1 : 2 * looks) {
      PartsQuestion question;
      question.looks = looks;
      const FirstContact found = first_contact(a, s.motion_a, b, s.motion_b, 1.0, question).contact;
      ASSERT_LE(found.t_lo, expected.t_hi) << "seed 20260212, pair " << i << ", looks " << looks;
      ASSERT_GE(found.t_hi, expected.t_lo) << "seed 20260212, pair " << i << ", looks " << looks;
      ASSERT_TRUE(found.verdict == Verdict::undecided || found.verdict == expected.verdict) << i;
      ASSERT_TRUE(looks > 0 || found.verdict == Verdict::undecided) << i;
      ASSERT_GE(found.t_lo, known) << "more looks never know less";
      known = found.t_lo;
      undecided += found.verdict == Verdict::undecided, hits += found.verdict == Verdict::hit;
    }
  }
  EXPECT_GT(undecided, 900);
  EXPECT_GT(hits, 300);
}

TEST(FirstPartsContact, InASceneIsTheFirstWallOnTheWay) {
  std::vector<Convex> posts;
  for (int x = -40; x <= 40; ++x)
    for (int y = -40; y <= 40; ++y) posts.push_back(disc(0.2, {x + 0.5, y + 0.5}));
  const PartsBvh scene = parts_bvh(posts);
  const std::vector<Convex> ball{disc(0.29)};
  const PartsBvh moving = parts_bvh(ball);
  // Between two rows, until the slope has used up what is free beside it.
  BvhCounters counters;
  const FirstPartsContact found =
      first_contact(moving, {{-30, 0}, 0, {60, 1}, 9}, scene, {}, 1.0, {1e-12, 10000, 100000, &counters});
  ASSERT_EQ(found.contact.verdict, Verdict::hit);
  for (std::size_t j = 0; j < posts.size(); ++j) {
    const FirstContact one = first_contact(ball[0], {{-30, 0}, 0, {60, 1}, 9}, posts[j], {}, 1.0);
    EXPECT_GE(one.t_lo, found.contact.t_lo - 1e-13);
    EXPECT_TRUE(j != found.part_b || one.t_lo <= found.contact.t_hi);
  }
  EXPECT_LT(counters.leaves, 200u) << "of 6561 posts";
  EXPECT_EQ(first_contact(moving, {{-30, 0}, 0, {60, 0}, 9}, scene, {}, 1.0).contact.verdict, Verdict::free);
}

TEST(FirstPartsContact, OfSolidsThatBeginInContactIsAtOnce) {
  const std::vector<Convex> two{disc(1.0, {-1, 0}), disc(1.0, {1, 0})};
  const PartsBvh solid = parts_bvh(two);
  for (const double x : {4.0, 3.0, 0.0}) {
    const FirstPartsContact found = first_contact(solid, {}, solid, {{x, 0}, 0, {0, 0}, 5}, 1.0);
    EXPECT_EQ(found.contact.verdict, Verdict::hit);
    EXPECT_EQ(found.contact.t_hi, 0.0);
  }
}

TEST(FirstPartsContact, TellsThePartThatTouches) {
  const std::vector<Convex> dumbbell{disc(0.5, {-2, 0}), disc(0.5, {2, 0})}, wall{segment({-9, 0}, {9, 0})};
  const Motion falling{{0, 5}, 0.1, {0, -1}, 0};  // its first ball hangs lower
  const FirstPartsContact found = first_contact(parts_bvh(dumbbell), falling, parts_bvh(wall), {}, 9.0);
  EXPECT_EQ(found.part_a, 0u);
  const double height = 5.0 - 2.0 * std::sin(0.1) - 0.5;
  EXPECT_LE(found.contact.t_lo, height + 1e-15);
  EXPECT_GE(found.contact.t_hi, height - 1e-15);
}

TEST(AdvanceScalar, AgreesWithTheFirstContactAndTakesMoreLooks) {
  Random random(20260211);
  long looks[3] = {0, 0, 0};
  for (int i = 0; i < 1000; ++i) {
    const MovingPairOfShapes p = random_motions(random);
    const FirstContact expected = first_contact(p.a, p.motion_a, p.b, p.motion_b, 1.0);
    looks[0] += expected.evaluations;
    for (const Closing closing : {Closing::scalar, Closing::directional}) {
      const FirstContact found =
          advance_scalar(p.a, p.motion_a, p.b, p.motion_b, 1.0, closing, {1e-9, 100000});
      looks[closing == Closing::scalar ? 1 : 2] += found.evaluations;
      ASSERT_EQ(found.verdict, expected.verdict) << "seed 20260211, pair " << i;
      EXPECT_LE(found.t_lo, expected.t_hi) << "seed 20260211, pair " << i;
      EXPECT_GT(found.t_lo, expected.t_lo - 1e-5) << "seed 20260211, pair " << i;
    }
  }
  std::printf("distances a path: %g, scalar %g, directional %g\n", looks[0] / 1e3, looks[1] / 1e3,
              looks[2] / 1e3);
  EXPECT_LT(looks[2], looks[1]);
  EXPECT_LT(3 * looks[0], looks[2]);
}

}  // namespace
}  // namespace throng::narrowphase
