// SPDX-License-Identifier: MIT
#include "narrowphase/motion/check_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace throng::narrowphase {
namespace {

/// A solid with its parts.
struct Solid {
  explicit Solid(std::vector<Convex> given) : parts(std::move(given)), shape(parts_bvh(parts)) {}
  explicit Solid(Convex part) : Solid(std::vector<Convex>{std::move(part)}) {}
  Solid(const Solid&) = delete;
  std::vector<Convex> parts;
  PartsBvh shape;
};

const Solid kBall(disc(1.0)), kBlock(convex({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}));
const Solid kBar(convex({{-2, -0.1}, {2, -0.1}, {2, 0.1}, {-2, 0.1}})), kPost(disc(0.3));

Motion still(const Vec& at) {
  return {at, 0.0, {0.0, 0.0}, 0.0};
}

TEST(CheckMotion, FindsDiscsThatMeetHeadOn) {
  const PathAnswer hit = check_motion(kBall.shape, still({0, 0}), kBall.shape, {{10, 0}, 0, {-9, 0}, 0}, 1.0);
  EXPECT_EQ(hit.verdict, Verdict::hit);
  EXPECT_GE(hit.from, 8.0 / 9.0);
  EXPECT_EQ(hit.from, hit.to);
}

TEST(CheckMotion, ProvesThatDiscsPassEachOther) {
  const PathAnswer past =
      check_motion(kBall.shape, still({0, 0}), kBall.shape, {{10, 2.001}, 0, {-20, 0}, 0}, 1.0);
  EXPECT_EQ(past.verdict, Verdict::free);
}

/// They pass at 0.9, meet for a hundredth, and come from opposite sides; one stands 50 m from its origin.
TEST(CheckMotion, LooksFirstWhereTheCentresPassEachOther) {
  const Solid grain(disc(0.05)), far(disc(0.05, {50, 0}));
  for (const double spin : {0.0, 2.0})
    for (const double way : {-1.0, 1.0}) {
      const Motion passes{{-18 * way, 0}, 0, {20 * way, 0}, spin}, stands = still({-50, 0});
      const PathAnswer a = check_motion(far.shape, stands, grain.shape, passes, 1.0);
      const PathAnswer b = check_motion(grain.shape, passes, far.shape, stands, 1.0);
      EXPECT_EQ(a.verdict, Verdict::hit);
      EXPECT_NEAR(a.from, 0.9, 1e-15);
      EXPECT_EQ(a.evaluations, 1u);
      EXPECT_EQ(b.from, a.from);
    }
}

/// One above the other: nowhere on their ways do they come nearer.
TEST(CheckMotion, AsksOnceAboutWhatStandsStill) {
  const PathAnswer rest = check_motion(kBall.shape, still({0, 0}), kBall.shape, still({0, 5}), 1.0);
  EXPECT_EQ(rest.verdict, Verdict::free);
  EXPECT_EQ(rest.evaluations, 1u);
}

TEST(CheckMotion, AsksOnceAboutWhatIsFarAway) {
  const PathAnswer far = check_motion(kBar.shape, {{0, 0}, 0, {1, 0}, 3}, kPost.shape, still({9, 0}), 1.0);
  EXPECT_EQ(far.verdict, Verdict::free);
  EXPECT_EQ(far.evaluations, 1u);
}

/// A disc through a gap between two posts that is wider by 1e-9 on each side, or narrower.
TEST(CheckMotion, TellsAGapThatIsJustWideEnoughFromOneThatIsNot) {
  for (const double spare : {1e-9, -1e-9}) {
    const Solid posts({disc(0.5, {0.0, 1.5 + spare}), disc(0.5, {0.0, -1.5 - spare})});
    const PathAnswer answer =
        check_motion(kBall.shape, {{-3, 0}, 0, {6, 0}, 0}, posts.shape, still({0, 0}), 1.0);
    EXPECT_EQ(answer.verdict, spare > 0.0 ? Verdict::free : Verdict::hit) << spare;
  }
}

/// A square on its corner reaches sqrt(2) far: a wall at that height is touched, one above isn't.
TEST(CheckMotion, KnowsHowFarASpinningSquareReaches) {
  const Solid wall(segment({-9, 0}, {9, 0}));
  for (const double clearance : {1e-6, -1e-6}) {
    const PathAnswer answer = check_motion(kBlock.shape, {{0, 0}, 0, {0, 0}, 2}, wall.shape,
                                           still({0, std::sqrt(2.0) + clearance}), 1.0);
    EXPECT_EQ(answer.verdict, clearance > 0 ? Verdict::free : Verdict::hit) << clearance;
  }
}

TEST(CheckMotion, AnswersAtOnceFromTheStart) {
  const PathAnswer touching =
      check_motion(kBall.shape, {{0, 0}, 0, {-1, 0}, 0}, kBall.shape, still({2, 0}), 1.0);
  EXPECT_EQ(touching.verdict, Verdict::hit);
  EXPECT_EQ(touching.from, 0.0);
  EXPECT_LE(touching.evaluations, 3u);
  const PathAnswer inside =
      check_motion(kBall.shape, {{0, 0}, 0, {9, 0}, 0}, kPost.shape, still({0, 0}), 1.0);
  EXPECT_EQ(inside.verdict, Verdict::hit);
  EXPECT_LE(inside.evaluations, 3u);
}

TEST(CheckMotion, OfWhatStandsStillAsksOnce) {
  for (const double duration : {0.0, 1.0, 1e300}) {
    for (const double speed : {0.0, 5e-324}) {
      const Motion moving{{3, 0}, 0.5, {-speed, speed}, speed};
      if (speed * duration > 1e-9) continue;
      const PathAnswer apart = check_motion(kBall.shape, still({0, 0}), kPost.shape, moving, duration);
      EXPECT_EQ(apart.verdict, Verdict::free);
      EXPECT_EQ(apart.evaluations, 1u);
      const PathAnswer same = check_motion(kBall.shape, moving, kBall.shape, moving, duration);
      EXPECT_EQ(same.verdict, Verdict::hit);
      EXPECT_EQ(same.evaluations, 1u);
    }
  }
}

/// The short end of a bar turns past a post. At a clearance of 1e-4 distances over rates alone take 700
/// computations.
TEST(CheckMotion, NeedsFewDistancesToPassAPostClosely) {
  const Solid bar(convex({{-4, -0.1}, {2, -0.1}, {2, 0.1}, {-4, 0.1}}));
  for (const auto& [clearance, most] : {std::pair{1.0, 5u}, {1e-2, 15u}, {1e-4, 25u}, {1e-9, 60u}}) {
    const double reach = std::hypot(2.0, 0.1) + 0.3 + clearance;
    const Vec post = reach * pose({0, 0}, 1.2).rotate({1, 0});
    const PathAnswer answer =
        check_motion(bar.shape, {{0, 0}, 0, {0, 0}, 2.7}, kPost.shape, still(post), 1.0);
    EXPECT_EQ(answer.verdict, Verdict::free) << clearance;
    EXPECT_LE(answer.evaluations, most) << clearance;
  }
}

/// The flat side of a bar over the thorn of a static scene, which stands by its origin or 1,000 m away.
TEST(CheckMotion, NeedsAsFewWhereAStaticSceneIsFarFromItsOrigin) {
  const Solid bar(convex({{-2, 0}, {2, 0}, {2, 0.2}, {-2, 0.2}}));
  for (const Vec& far : {Vec(0, 0), Vec(600, 800)}) {
    const Solid thorn(convex({far, far + Vec(0.2, -1), far + Vec(0.5, -1)}));
    const PathAnswer answer = check_motion(bar.shape, {far + Vec(0.05, 1e-6), -0.1, {-0.1, 0}, 0.2},
                                           thorn.shape, still({0, 0}), 1.0);
    EXPECT_EQ(answer.verdict, Verdict::free) << far.x();
    EXPECT_LE(answer.evaluations, 30u) << far.x();
  }
}

TEST(CheckMotion, AsksOnceAboutACornerThatGlidesAlongAWall) {
  const std::vector<Vec> wall{{-9, -1}, {9, -1}, {9, 0}, {-9, 0}}, wedge{{0, 0}, {0.8, 1}, {-0.8, 1}};
  const Motion gliding = {{-2, 2e-9}, -0.4, {4, 0}, 0.8};
  const Solid parts_a(convex(wall)), parts_b(convex(wedge));
  EXPECT_EQ(check_motion(parts_a.shape, {}, parts_b.shape, gliding, 1.0).evaluations, 1u);
  const auto a = outline<BoxAndBall<2>>(std::span(&wall, 1)),
             b = outline<BoxAndBall<2>>(std::span(&wedge, 1));
  const PathAnswer answer = check_motion(a, {}, b, gliding, 1.0);
  EXPECT_EQ(answer.verdict, Verdict::free);
  EXPECT_LE(answer.evaluations, 5u);
}

/// A million turns beside a post: out of reach, or hit somewhere.
TEST(CheckMotion, CountsNoTurns) {
  const Motion fast{{0, 0}, 0, {0, 0}, 6.28e6};
  const auto beside = [&](const Solid& solid, double at) {
    return check_motion(solid.shape, fast, kPost.shape, still({at, 0}), 1.0);
  };
  EXPECT_EQ(beside(kBar, 2.2).verdict, Verdict::hit);
  for (const PathAnswer& clear : {beside(kBar, 2.31), beside(kBall, 1.31), beside(kBall, 1.300001)}) {
    EXPECT_EQ(clear.verdict, Verdict::free);
    EXPECT_EQ(clear.evaluations, 1u);
  }
}

TEST(CheckMotion, NamesThePartOfAStaticSceneThatIsHit) {
  std::vector<Convex> obstacles;
  for (int i = 0; i < 100; ++i) obstacles.push_back(disc(0.1, {1.0 * i, i == 70 ? 0.0 : 5.0}));
  const Solid scene(obstacles);
  const PathAnswer answer =
      check_motion(kPost.shape, {{-1, 0}, 0, {120, 0}, 0}, scene.shape, still({0, 0}), 1.0);
  EXPECT_EQ(answer.verdict, Verdict::hit);
  EXPECT_EQ(answer.part_b, 70u);
}

TEST(CheckMotions, AnswerEachSegmentOfAPath) {
  std::vector<SolidPair<>> path;
  const Vec corners[] = {{-5, 0}, {-5, 5}, {5, 5}, {-5, -5}, {-9, -9}};
  for (std::uint32_t s = 0; s < 4; ++s)
    path.push_back({{&kBall.shape, {corners[s], 0, corners[s + 1] - corners[s], 0}},
                    {&kPost.shape, still({0, 0})},
                    1.0,
                    s});
  BisectScratch scratch;
  std::vector<PathAnswer> answers(4);
  const PathAnswer all = check_motions<PartsBvh>(path, {}, scratch, answers);
  EXPECT_EQ(all.verdict, Verdict::hit);
  EXPECT_EQ(all.segment, 2u);
  EXPECT_EQ(all.pair, 2u);
  std::size_t evaluations = 0;
  for (std::size_t s = 0; s < 4; ++s) {
    EXPECT_EQ(answers[s].verdict, s == 2 ? Verdict::hit : Verdict::free) << s;
    evaluations += answers[s].evaluations;
  }
  EXPECT_EQ(all.evaluations, evaluations);
  EXPECT_LE(check_motions<PartsBvh>(path, {}, scratch).evaluations, 2u) << "the longest segment comes first";
}

}  // namespace
}  // namespace throng::narrowphase
