// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/sampled_linkage.h"

#include <gtest/gtest.h>

#include "linkage_world.h"

namespace throng::narrowphase {
namespace {

TEST(SampleMotion, TakesAsManyConfigurationsAsTheWayHasSteps) {
  World world = bar_and_post(2.0, {0.0, 3.0}, 0.1);
  LinkageChecker checker = world.checker();
  const LinkageAnswer answer = sample_motion(checker, std::vector{0.0}, std::vector{1.0}, 0.01);
  EXPECT_EQ(answer.verdict, Verdict::free);
  EXPECT_NEAR(static_cast<double>(answer.evaluations), 201.0, 1.0);
}

TEST(SampleMotion, MissesAPostThatIsThinnerThanItsStepAndFindsItWithALesser) {
  World world = bar_and_post(2.0, {1.0, 1.0}, 0.001);
  LinkageChecker checker = world.checker();
  const std::vector<double> from{0.0}, to{2.0};
  EXPECT_EQ(checker.check_motion(from, to).verdict, Verdict::hit);
  EXPECT_EQ(sample_motion(checker, from, to, 0.5).verdict, Verdict::free);
  const LinkageAnswer hit = sample_motion(checker, from, to, 1e-3);
  EXPECT_EQ(hit.verdict, Verdict::hit);
  EXPECT_NEAR(hit.from, std::numbers::pi / 8, 1e-3);
  EXPECT_EQ(hit.pair, (LinkPair{0, kWorld}));
}

/// Ten links among a thousand polygons, as planners meet them.
TEST(SampleMotion, TakesMoreThanTheExactAnswerDoes) {
  Random random(17);
  World world;
  world.linkage = arm(world.shapes, 10, 0.5, 0.01);
  std::vector<Convex> parts;
  while (parts.size() < 1000) {
    const Vec at = random_vec(random, 8.0, 8.0);
    std::vector<Vec> points;
    for (int k = 0; k < 7; ++k) points.push_back(at + random_vec(random, 0.015, 0.015));
    if (at.norm() > 0.6) parts.push_back(convex(hull(points)));
  }
  world.obstacles = world.shapes.add(std::move(parts));
  LinkageChecker checker = world.checker();
  std::size_t exact = 0, sampled = 0;
  for (int free = 0; free < 20;) {
    std::vector<double> from, to;
    for (int i = 0; i < 10; ++i) {
      from.push_back(uniform(random, -1.2, 1.2));
      to.push_back(from.back() + uniform(random, -0.1, 0.1));
    }
    const LinkageAnswer answer = checker.check_motion(from, to);
    if (answer.verdict != Verdict::free) continue;
    const LinkageAnswer samples = sample_motion(checker, from, to, 5e-3);
    EXPECT_EQ(samples.verdict, Verdict::free) << "seed 17, motion " << free;
    exact += answer.evaluations, sampled += samples.evaluations * world.pairs.size(), ++free;
  }
  RecordProperty("pairs_asked_exact", static_cast<int>(exact));
  RecordProperty("pairs_asked_sampling", static_cast<int>(sampled));
  EXPECT_LT(10 * exact, sampled);
}

}  // namespace
}  // namespace throng::narrowphase
