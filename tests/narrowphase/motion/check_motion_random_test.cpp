// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>

#include "moving_solids.h"
#include "narrowphase/motion/check_motion.h"
#include "tests/less_when_watched.h"

namespace throng::narrowphase {
namespace {

/// Two solids with their ways.
struct Crossing {
  std::vector<Convex> a, b;
  PartsBvh tree_a, tree_b;
  Motion motion_a, motion_b;

  explicit Crossing(Random& random) : a(random_solid(random)), b(random_solid(random)) {
    tree_a = parts_bvh(a), tree_b = parts_bvh(b);
    motion_a = random_motion(random), motion_b = random_motion(random);
  }
  Crossing(const Crossing&) = delete;

  PathAnswer answer() const { return check_motion(tree_a, motion_a, tree_b, motion_b, 1.0); }
  double distance(double t) const {
    return separation(tree_a, pose_at(motion_a, t), tree_b, pose_at(motion_b, t)).distance;
  }
};

TEST(CheckMotionAtRandom, IsNeverContradictedBySamples) {
  Random random(20261121);
  int hits = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Crossing crossing(random);
    const PathAnswer answer = crossing.answer();
    ASSERT_NE(answer.verdict, Verdict::undecided) << "seed 20261121, trial " << trial;
    hits += answer.verdict == Verdict::hit;
    if (answer.verdict == Verdict::hit) {
      ASSERT_LE(crossing.distance(answer.from), 0.0) << "seed 20261121, trial " << trial;
      continue;
    }
    const int samples = static_cast<int>(less_when_watched(trial % 1000 == 0 ? 1000000 : 500));
    for (int i = 0; i <= samples; ++i)
      ASSERT_GT(crossing.distance(static_cast<double>(i) / samples), 0.0) << "seed 20261121, trial " << trial;
  }
  EXPECT_GT(hits, 900);
  EXPECT_LT(hits, 2100);
}

/// Each neighbourhood by itself, at its very ends.
TEST(CheckMotionAtRandom, ProvesNothingThatIsFalse) {
  Random random(20261122);
  std::size_t proven = 0;
  double tightest = 0.0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Crossing crossing(random);
    std::vector<Neighbourhood> covering;
    check_motion(crossing.tree_a, crossing.motion_a, crossing.tree_b, crossing.motion_b, 1.0,
                 {0.0, &covering});
    for (const Neighbourhood& n : covering) {
      if (!n.proven) continue;
      for (const double t : {n.from, 0.5 * (n.from + n.time), 0.5 * (n.time + n.to), n.to})
        ASSERT_GT(crossing.distance(t), 0.0) << "seed 20261122, trial " << trial << ", time " << t;
      const double start = crossing.distance(n.time);
      tightest = std::max(tightest, 1.0 - crossing.distance(n.to) / start);
      ++proven;
    }
  }
  RecordProperty("tightest", std::to_string(tightest));
  EXPECT_GT(proven, 2500u);
  EXPECT_GT(tightest, 0.99) << "some go as far as they can";
}

TEST(CheckMotionAtRandom, SaysTheSameOfSwappedReversedAndMovedMotions) {
  Random random(20261123);
  for (int trial = 0; trial < 2000; ++trial) {
    const Crossing c(random);
    const Verdict verdict = c.answer().verdict;
    EXPECT_EQ(check_motion(c.tree_b, c.motion_b, c.tree_a, c.motion_a, 1.0).verdict, verdict) << trial;
    EXPECT_EQ(
        check_motion(c.tree_a, reversed(c.motion_a, 1.0), c.tree_b, reversed(c.motion_b, 1.0), 1.0).verdict,
        verdict)
        << trial;
    const double angle = uniform(random, -4, 4);
    const Vec shift = random_vec(random, 100, 100);
    EXPECT_EQ(check_motion(c.tree_a, moved(c.motion_a, angle, shift), c.tree_b,
                           moved(c.motion_b, angle, shift), 1.0)
                  .verdict,
              verdict)
        << trial;
  }
}

TEST(CheckMotionAtRandom, AnswersABatchAsOneByOne) {
  Random random(20261124);
  std::vector<std::unique_ptr<Crossing>> crossings;
  std::vector<SolidPair<>> pairs;
  for (std::uint32_t k = 0; k < 200; ++k) {
    crossings.push_back(std::make_unique<Crossing>(random));
    const Crossing& c = *crossings.back();
    pairs.push_back({{&c.tree_a, c.motion_a}, {&c.tree_b, c.motion_b}, 1.0, k});
  }
  BisectScratch scratch;
  std::vector<PathAnswer> answers(pairs.size());
  const PathAnswer all = check_motions<PartsBvh>(pairs, {}, scratch, answers);
  EXPECT_EQ(all.verdict, Verdict::hit);
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    const PathAnswer alone = crossings[k]->answer();
    EXPECT_EQ(answers[k].verdict, alone.verdict) << k;
    EXPECT_EQ(answers[k].from, alone.from) << k;
    EXPECT_EQ(answers[k].evaluations, alone.evaluations) << k;
  }
}

/// Two polygons as outlines and as unions of convex pieces.
TEST(CheckMotionAtRandom, SaysTheSameOfOutlinesAsOfTheirPieces) {
  Random random(20261125);
  int hits = 0, inside = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<Vec> ring_a = random_simple(random, 12), ring_b = random_simple(random, 9);
    if (trial % 5 == 0)
      for (Vec& v : ring_b) v *= 0.02;
    const std::vector<Convex> pieces_a = decompose(ring_a, 0.0), pieces_b = decompose(ring_b, 0.0);
    const auto a = outline<BoxAndBall<2>>(std::span(&ring_a, 1));
    const auto b = outline<BoxAndBall<2>>(std::span(&ring_b, 1));
    const Motion motion_a = random_motion(random), motion_b = random_motion(random);
    const PathAnswer found = check_motion(a, motion_a, b, motion_b, 1.0);
    const PathAnswer expected =
        check_motion(parts_bvh(pieces_a), motion_a, parts_bvh(pieces_b), motion_b, 1.0);
    ASSERT_EQ(found.verdict, expected.verdict) << "seed 20261125, trial " << trial;
    if (found.verdict != Verdict::hit) continue;
    ++hits;
    const Pose pose_a = pose_at(motion_a, found.from), pose_b = pose_at(motion_b, found.from);
    ASSERT_TRUE(collide(a, pose_a, b, pose_b)) << trial;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> meetings;
    find_meetings(a, pose_a, b, pose_b, meetings);
    inside += meetings.empty();
  }
  EXPECT_GT(hits, 300);
  EXPECT_LT(hits, 700);
  EXPECT_GT(inside, 20);
}

}  // namespace
}  // namespace throng::narrowphase
