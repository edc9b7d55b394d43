// SPDX-License-Identifier: MIT
// What is known of contacts without a search has the bits of a search, whatever the machine's vectors.
#include "sim/contact/held_faces.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>

#include "sim/contact/seat_book.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

const char* const kHeldPolygons =
    "sleep = false\ngravity = [0, -9.81]\ntime = { dt = 0.016, until = 60, substeps = 3 }\n"
    "[materials.default]\nfriction = 0.5\n"
    "[shapes]\n"
    "box = { polygon = [[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4]] }\n"
    "three = { polygon = [[0.45, -0.21], [-0.2, 0.44], [-0.05, -0.47]] }\n"
    "seven = { polygon = [[0.5, 0], [0.34, 0.31], [-0.21, 0.38], [-0.41, 0.24], [-0.46, -0.17], "
    "[-0.17, -0.4], [0.33, -0.32]] }\n";

std::string placed(const char* shape, const char* within) {
  return std::string("[[bodies]]\nshape = \"") + shape +
         "\"\ncount = 12\nplace = { random = { within = " + within + ", gap = 0.01 } }\n";
}

std::string all_placed(const char* within) {
  return placed("box", within) + placed("three", within) + placed("seven", within);
}

class HeldFacesOnEachTarget : public ::testing::TestWithParam<std::int64_t> {
 protected:
  HeldFacesOnEachTarget() { choose(GetParam()); }
  ~HeldFacesOnEachTarget() override { choose(0); }

  static void choose(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }

  /// Goes on beside a run that knows nothing in any step. Returns how many contacts were known.
  static std::size_t expect_bits_of_a_search(const Scene& scene, int steps) {
    Trial holds(scene, 2), searches(scene);
    std::size_t known = 0, known_afresh = 0;
    for (int i = 0; i < steps; ++i) {
      holds.steps(1);
      Trial afresh(scene);
      afresh.state = searches.state;
      afresh.steps(1);
      searches.state = afresh.state;
      EXPECT_EQ(hash(holds.state), hash(searches.state)) << "step " << i;
      if (::testing::Test::HasFailure()) return 0;
      known_afresh += afresh.work.finder.held().known();  // where the step was taken again
      known += holds.work.finder.held().known();
    }
    EXPECT_LT(10 * known_afresh, known);
    return known;
  }
};

TEST_P(HeldFacesOnEachTarget, HaveTheBitsOfASearchInAPile) {
  const std::size_t known = expect_bits_of_a_search(
      scene_from(kHeldPolygons + all_placed("[[0, 0], [6, 12]]") + "[domain]\nbox = [[0, 0], [6, 12]]\n"),
      500);
  EXPECT_GT(known, 5'000u);
}

TEST_P(HeldFacesOnEachTarget, HaveTheBitsOfASearchAcrossASeam) {
  const std::size_t known = expect_bits_of_a_search(
      scene_from(kHeldPolygons + all_placed("[[0, 1], [6, 11]]") +
                 "[[walls]]\nsegment = [[-3, 0.5], [9, 0.5]]\n[domain]\nperiodic = [[0, 0], [6, 24]]\n"),
      500);
  EXPECT_GT(known, 5'000u);
}

TEST_P(HeldFacesOnEachTarget, HaveTheBitsOfASearchOnWhatTurns) {
  const std::size_t known = expect_bits_of_a_search(
      scene_from(kHeldPolygons + all_placed("[[0, 2], [6, 12]]") + "[domain]\nbox = [[0, 0], [6, 12]]\n" +
                 "[[bodies]]\nshape = \"seven\"\nat = [3, 1]\nkind = \"kinematic\"\nspin = 0.2\n"),
      2000);
  EXPECT_GT(known, 5'000u);  // fewer than elsewhere: what the one that turns stirs is searched again
}

// Bodies of two convex parts, which are searched in each step, among the others.
TEST_P(HeldFacesOnEachTarget, HaveTheBitsOfASearchBesideBodiesInParts) {
  const std::size_t known = expect_bits_of_a_search(
      scene_from(
          kHeldPolygons +
          std::string("corner = { polygon = [[0, 0], [0.9, 0], [0.9, 0.3], [0.3, 0.3], "
                      "[0.3, 0.9], [0, 0.9]] }\n") +
          all_placed("[[0, 0], [6, 14]]") +
          "[[bodies]]\nshape = \"corner\"\ncount = 4\nplace = { random = { within = [[0, 14], [6, 19]], "
          "gap = 0.01 } }\n[domain]\nbox = [[0, 0], [6, 20]]\n"),
      900);
  EXPECT_GT(known, 5'000u);
}

// A box that lands on one that rests on another: whom it stops with it mustn't depend on what is held.
TEST_P(HeldFacesOnEachTarget, HaveTheBitsOfASearchUnderWhoLandsOnThem) {
  const std::size_t known = expect_bits_of_a_search(
      scene_from(kHeldPolygons + std::string("[[walls]]\nsegment = [[-50, 0], [50, 0]]\n"
                                             "[[bodies]]\nshape = \"box\"\nat = [0, 0.4]\n"
                                             "[[bodies]]\nshape = \"box\"\nat = [0.02, 1.2]\n"
                                             "[[bodies]]\nshape = \"box\"\nat = [0.3, 3.2]\n")),
      200);
  EXPECT_GT(known, 20u);
}

// An edge so short that the difference of its ends has few digits.
TEST_P(HeldFacesOnEachTarget, HaveTheBitsOfASearchWhereEdgesAreTiny) {
  const std::string cut =
      "cut = { polygon = [[-0.4, -0.4], [0.39999, -0.4], [0.4, -0.39999], [0.4, 0.4], "
      "[0.00001, 0.40001], [-0.4, 0.4]] }\n";
  const std::size_t known = expect_bits_of_a_search(
      scene_from("seed = 2\n" + std::string(kHeldPolygons) + cut + placed("cut", "[[0, 0], [6, 14]]") +
                 placed("cut", "[[0, 0], [6, 14]]") + placed("box", "[[0, 0], [6, 14]]") +
                 "[domain]\nbox = [[0, 0], [6, 14]]\n"),
      900);
  EXPECT_GT(known, 500u);
}

const auto held_target_name = [](const auto& target) { return std::string(hwy::TargetName(target.param)); };
INSTANTIATE_TEST_SUITE_P(, HeldFacesOnEachTarget, ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         held_target_name);

/// Two unit squares, of which the second stood there when they were searched.
class TwoSquares {
 public:
  explicit TwoSquares(const Vec& at) {
    lane_ = held_.take({0, 1});
    const narrowphase::Pose b_in_a{at};
    const auto m = narrowphase::manifold(square_, {}, square_, b_in_a, 2.0 * kReach);
    if (m.count > 0) feature_ = m.points[0].feature;
    held_.hold(lane_, narrowphase::hold(square_, square_, b_in_a, m), square_, square_, 0.0);
  }

  /// How many points are known now that it stands there; -1 for none. `pressed`: in the step before.
  int points(const Vec& at, bool pressed = false) {
    const PlacedPart parts[] = {{0.0, 0.0, 1.0, 0.0, 1.0, 6.0, kReach, 0.0},
                                {at.x(), at.y(), 1.0, 0.0, 1.0, 6.0, kReach, 0.0}};
    face_.count = 2;
    held_.ask(lane_, pressed ? &feature_ : nullptr, nullptr);
    held_.answer(0, held_.blocks(), parts, 1.0, std::span(&face_, seated_));
    return held_.knows(lane_) ? held_.points(lane_) : -1;
  }

  /// Where the contact is solved: in the first lane.
  const FaceBlock& face() const { return face_; }

  /// To the seat of some other face, or behind all of them.
  void move_to_seat(std::uint32_t lane) {
    HeldFaces::Move move{{0, 1}, lane_, lane};
    held_.move(1, std::span(&move, 1));
    lane_ = move.to, seated_ = 1;
  }
  void move(std::uint32_t lane) { held_.move(lane_, lane), lane_ = lane; }
  std::uint32_t lane() const { return lane_; }

 private:
  static constexpr double kReach = 0.05;  // m, of each

  const narrowphase::Convex square_ =
      narrowphase::convex({Vec(-0.5, -0.5), Vec(0.5, -0.5), Vec(0.5, 0.5), Vec(-0.5, 0.5)});
  HeldFaces held_;
  FaceBlock face_{};
  std::size_t seated_ = 1;
  std::uint32_t lane_ = 0, feature_ = 0;
};

// The second square 0.25 m aside and 0.01 m in the first: 0.75 m of the faces cover each other.
TEST(HeldFaces, DescribesTheFaceOfTwoSquares) {
  TwoSquares squares({0.25, 0.99});
  ASSERT_EQ(squares.points({0.25, 0.99}, true), 2);
  const FaceBlock& block = squares.face();
  EXPECT_EQ(block.normal_x[0], 0.0);
  EXPECT_EQ(block.normal_y[0], 1.0);
  const double x[] = {0.5, -0.25};
  for (int i : {0, 1}) {
    const FaceBlock::Point& point = block.points[i];
    EXPECT_NEAR(point.first_ax[0], x[i], 1e-15);
    EXPECT_NEAR(point.first_ay[0], 0.495, 1e-15);
    EXPECT_NEAR(point.first_bx[0], x[i] - 0.25, 1e-15);
    EXPECT_NEAR(point.first_by[0], -0.495, 1e-15);
    EXPECT_NEAR(point.gap[0] + 0.99 - 2.0 * 0.495, -0.01, 1e-15);
    EXPECT_NEAR(point.normal_mass[0], 1.0 / (2.0 + 6.0 * (x[i] * x[i] + (x[i] - 0.25) * (x[i] - 0.25))),
                1e-15);
    EXPECT_NEAR(point.tangent_mass[0], 1.0 / (2.0 + 12.0 * 0.495 * 0.495), 1e-15);
  }
}

TEST(HeldFaces, KnowsNothingOfWhoMovedTooFar) {
  TwoSquares squares({0.25, 0.99});
  EXPECT_EQ(squares.points({0.35, 0.99}, true), 2) << "0.1 m of 0.37";
  EXPECT_EQ(squares.points({0.25, 1.2}), 0) << "beyond reach";
  EXPECT_EQ(squares.points({0.99, 0.25}, true), -1) << "on another side";
  EXPECT_EQ(squares.points({0.7, 0.99}, true), -1) << "0.45 m of 0.37, on the same side";
}

// Faces that are equally wide take turns: which is the reference, the last step says.
TEST(HeldFaces, LeavesEquallyWideFacesToASearchUnlessOneWasTheReference) {
  TwoSquares squares({0.25, 0.99});
  EXPECT_EQ(squares.points({0.25, 0.99}), -1);
  EXPECT_EQ(squares.points({0.25, 0.99}, true), 2);
}

TEST(HeldFaces, LeavesCornersToASearch) {
  TwoSquares squares({0.999, 1.02});
  EXPECT_EQ(squares.points({0.998, 1.02}, true), 2);
  EXPECT_EQ(squares.points({1.002, 1.02}, true), -1);
}

TEST(HeldFaces, KnowsThoseApartUntilTheyMayBeWithinReach) {
  TwoSquares squares({0.25, 1.5});
  EXPECT_EQ(squares.points({0.25, 1.5}), 0);
  EXPECT_EQ(squares.points({0.25, 1.31}), 0) << "0.19 m nearer of 0.5 m less a reach of 0.1";
  EXPECT_EQ(squares.points({0.25, 1.09}), -1) << "within reach";
  EXPECT_EQ(squares.points({0.75, 1.5}), -1) << "moved by 0.5 m, if not nearer";
}

/// A heap that falls asleep, whose islands leave the loop, and that somebody comes down on later.
TEST(HeldFaces, HaveTheBitsOfASearchWhereBodiesSleepAndWake) {
  std::string text = kHeldPolygons + all_placed("[[0, 0], [6, 12]]") +
                     "[domain]\nbox = [[0, 0], [6, 400]]\n" + "[[bodies]]\nshape = \"box\"\nat = [3, 390]\n";
  text.replace(text.find("sleep = false"), 13, "sleep = true");
  const Scene scene = scene_from(text);
  Trial holds(scene), searches(scene);
  std::size_t most_asleep = 0, woken = 0;
  for (int i = 0; i < 900; ++i) {
    const std::size_t before = asleep(holds.state.sleep);
    holds.steps(1);
    Trial afresh(scene);
    afresh.state = searches.state;
    afresh.work.sleepers.look(afresh.state, afresh.work.candidates);
    afresh.steps(1);
    searches.state = afresh.state;
    ASSERT_EQ(hash(holds.state), hash(searches.state)) << "step " << i;
    most_asleep = std::max(most_asleep, asleep(holds.state.sleep));
    woken += asleep(holds.state.sleep) < before;
  }
  EXPECT_GT(most_asleep, 10u);
  EXPECT_GT(woken, 0u);
}

TEST(HeldFaces, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = scene_from(
      kHeldPolygons + std::string("[[bodies]]\nshape = \"box\"\nplace = { lattice = { origin = [0.5, 0.4], "
                                  "spacing = [0.85, 0.8], size = [60, 40] } }\n"
                                  "[domain]\nbox = [[0, 0], [52, 60]]\n"));
  Trial one(scene, 1), two(scene, 2);
  for (int i = 0; i < 40; ++i) {
    one.steps(1), two.steps(1);
    ASSERT_EQ(hash(one.state), hash(two.state)) << "step " << i;
    ASSERT_EQ(one.work.finder.held().known(), two.work.finder.held().known());
  }
  EXPECT_GT(one.work.finder.held().known(), 2'000u);
}

// Where nothing pushes, a velocity of -0 would become 0 in some seats and not in others.
TEST(HeldFaces, MeetNoVelocityOfMinusZero) {
  std::string text = kHeldPolygons + std::string("[[bodies]]\nshape = \"box\"\nat = [3, 1]\n") +
                     "[[walls]]\nsegment = [[0, -9], [9, -9]]\n";
  text.replace(text.find("gravity = [0, -9.81]"), 20, "gravity = [0, 0]");
  Trial run(scene_from(text));
  run.state.velocity[0] = {-0.0, -0.0}, run.state.spin[0] = -0.0;
  run.steps(1);
  EXPECT_FALSE(std::signbit(run.state.velocity[0].x()));
  EXPECT_FALSE(std::signbit(run.state.velocity[0].y()));
  EXPECT_FALSE(std::signbit(run.state.spin[0]));
}

// What isn't known, or has one point, or none, has no mass where it is solved: of garbage there, nothing is
// left.
TEST(HeldFaces, LeaveNoMassWhereTheyKnowNothing) {
  TwoSquares squares({0.25, 0.99});
  ASSERT_EQ(squares.points({0.25, 0.99}, true), 2);
  ASSERT_EQ(squares.points({0.7, 0.99}, true), -1);
  for (const FaceBlock::Point& point : squares.face().points)
    for (int lane = 0; lane < 8; ++lane) {
      EXPECT_EQ(point.normal_mass[lane], 0.0);
      EXPECT_EQ(point.tangent_mass[lane], 0.0);
      EXPECT_EQ(point.gap[lane], 0.0);
    }
}

TEST(HeldFaces, FollowThePairToAnotherLane) {
  TwoSquares squares({0.25, 0.99});
  squares.move_to_seat(5);
  EXPECT_EQ(squares.points({0.25, 0.99}, true), 2);
  EXPECT_EQ(squares.face().normal_y[5], 1.0);
  squares.move(3);
  EXPECT_EQ(squares.points({0.25, 0.99}, true), 2);
  EXPECT_EQ(squares.face().normal_y[3], 1.0);
  squares.move_to_seat(kNoLane);
  EXPECT_EQ(squares.lane(), 8u) << "behind the seats";
  EXPECT_EQ(squares.points({0.25, 0.99}, true), 2);
}

}  // namespace
}  // namespace throng
