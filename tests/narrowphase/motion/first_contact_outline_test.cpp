// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "moving_solids.h"
#include "narrowphase/distance.h"
#include "narrowphase/motion/first_contact_parts.h"
#include "narrowphase/relative.h"

namespace throng::narrowphase {
namespace {

using Ring = std::vector<Vec>;

template <class Volume>
Outline<Volume> solid(const Ring& ring) {
  return outline<Volume>(std::span(&ring, 1));
}

template <class Volume>
class FirstOutlineContact : public ::testing::Test {};
using PlanarVolumes = ::testing::Types<Ball<2>, Box<2>, OrientedBox<2>, BoxAndBall<2>>;
TYPED_TEST_SUITE(FirstOutlineContact, PlanarVolumes);

TYPED_TEST(FirstOutlineContact, OfACornerAndAWallIsTheirDistanceOverTheirSpeed) {
  const auto wedge = solid<TypeParam>({{0, 0}, {-2, 1}, {-2, -1}}), wall = solid<TypeParam>(square(3.0));
  const FirstPartsContact found = first_contact(wedge, {{-5, 0.5}, 0, {4, 0}, 0}, wall, {}, 1.0);
  ASSERT_EQ(found.contact.verdict, Verdict::hit);
  EXPECT_LE(found.contact.t_lo, 0.5);
  EXPECT_GE(found.contact.t_hi, 0.5);
  EXPECT_LE(found.contact.t_hi - found.contact.t_lo, 4e-12);
  EXPECT_EQ(found.part_b, 3u) << "its left side";
  EXPECT_NE(found.part_a, 1u) << "an edge that has the corner";
}

/// All edges that meet do so in line.
TYPED_TEST(FirstOutlineContact, OfBoxesInLineIsWhereTheSolidsMeet) {
  const auto box = solid<TypeParam>(square(1.0)), small = solid<TypeParam>(square(0.25));
  for (const auto& other : {box, small}) {
    const double apart = 4.0 - 1.0 - (other.start.x() == -1.0 ? 1.0 : 0.25);
    const FirstPartsContact found = first_contact(box, {{0, 0}, 0, {4, 0}, 0}, other, {{4, 0}}, 1.0);
    ASSERT_EQ(found.contact.verdict, Verdict::hit);
    EXPECT_LE(found.contact.t_lo, apart / 4.0 + 1e-15);
    EXPECT_GE(found.contact.t_hi, apart / 4.0 - 1e-15);
    EXPECT_LE(found.contact.t_hi - found.contact.t_lo, 1e-11);
  }
}

TYPED_TEST(FirstOutlineContact, IsAtOnceWhereOneHoldsTheOtherOrTheyTouch) {
  const auto large = solid<TypeParam>(square(3.0)), small = solid<TypeParam>(square(0.5));
  for (const Vec& at : {Vec(0, 0), Vec(2, 1), Vec(3.5, 0), Vec(3.2, 3.2)})
    for (const Motion& motion : {Motion{at}, Motion{at, 0, {9, 0}, 2}}) {
      EXPECT_EQ(first_contact(large, {}, small, motion, 1.0).contact.t_hi, 0.0);
      EXPECT_EQ(first_contact(small, motion, large, {}, 1.0).contact.verdict, Verdict::hit);
    }
}

TYPED_TEST(FirstOutlineContact, OfWhatMovesInAHoleIsItsFarSide) {
  const std::vector<Ring> rings{square(5.0), {{-3, -3}, {-3, 3}, {3, 3}, {3, -3}}};
  const auto frame = outline<TypeParam>(rings),
             wedge = solid<TypeParam>({{0.5, 0}, {-0.5, 0.3}, {-0.5, -0.3}});
  const FirstPartsContact found = first_contact(wedge, {{0, 0}, 0, {5, 1}, 0}, frame, {}, 1.0);
  ASSERT_EQ(found.contact.verdict, Verdict::hit);
  EXPECT_NEAR(found.contact.t_lo, 0.5, 1e-12);
  EXPECT_EQ(found.part_b, 6u) << "the hole's right side";
  EXPECT_EQ(first_contact(wedge, {{0, 0}, 0, {2, 1}, 1}, frame, {}, 1.0).contact.verdict, Verdict::free);
}

/// How far the two edges that it names are from each other at its end.
double between_named(const Ring& a, const Motion& motion_a, const Ring& b, const Motion& motion_b,
                     const FirstPartsContact& found) {
  const auto edge = [](const Ring& ring, std::uint32_t i) {
    return segment(ring[i], ring[next(i, ring.size())]);
  };
  const double time = found.contact.t_hi;
  return separation(edge(a, found.part_a), pose_at(motion_a, time), edge(b, found.part_b),
                    pose_at(motion_b, time))
      .distance;
}

/// The same polygons as unions of convex pieces, which overlap where outlines only cross.
TYPED_TEST(FirstOutlineContact, IsThatOfThePolygonsParts) {
  constexpr std::uint64_t kSeed = 20261124;
  Random random(kSeed);
  int hits = 0, inside = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    Ring ring_a = random_simple(random, 12), ring_b = random_simple(random, 9);
    if (trial % 5 == 0)
      for (Vec& v : ring_b) v *= 0.02;
    const std::vector<Convex> parts_a = decompose(ring_a, 0.0), parts_b = decompose(ring_b, 0.0);
    const auto a = solid<TypeParam>(ring_a), b = solid<TypeParam>(ring_b);
    const Motion motion_a = random_motion(random), motion_b = random_motion(random);
    const FirstPartsContact told = first_contact(a, motion_a, b, motion_b, 1.0);
    const FirstContact& found = told.contact;
    const FirstContact expected =
        first_contact(parts_bvh(parts_a), motion_a, parts_bvh(parts_b), motion_b, 1.0).contact;
    ASSERT_EQ(found.verdict, expected.verdict);
    ASSERT_LE(found.t_lo, expected.t_hi);
    ASSERT_GE(found.t_hi, expected.t_lo);
    const FirstContact swapped = first_contact(b, motion_b, a, motion_a, 1.0).contact;
    ASSERT_EQ(swapped.verdict, found.verdict);
    ASSERT_LE(swapped.t_lo, found.t_hi);
    ASSERT_GE(swapped.t_hi, found.t_lo);
    hits += found.verdict == Verdict::hit, inside += found.evaluations == 0 && found.verdict == Verdict::hit;
    if (found.verdict != Verdict::hit) continue;
    const Pose pose_a = pose_at(motion_a, found.t_hi), pose_b = pose_at(motion_b, found.t_hi);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> meetings;
    find_meetings(a, pose_a, b, pose_b, meetings);
    if (!meetings.empty()) {
      ASSERT_LE(between_named(ring_a, motion_a, ring_b, motion_b, told), 1e-12);
    }
    ASSERT_LE(found.t_hi - found.t_lo, 1e-9);
    ASSERT_TRUE(collide(a, pose_a, b, pose_b));
  }
  std::printf("seed %llu: %d of 1000 hit, %d of these at the start\n", static_cast<unsigned long long>(kSeed),
              hits, inside);
  EXPECT_GT(hits, 300);
  EXPECT_LT(hits, 700);
  EXPECT_GT(inside, 20);
  EXPECT_LT(inside, hits - 100);
}

}  // namespace
}  // namespace throng::narrowphase
