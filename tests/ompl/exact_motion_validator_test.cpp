// SPDX-License-Identifier: MIT
#include "tools/ompl/exact_motion_validator.h"

#include <gtest/gtest.h>
#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/util/Console.h>

#include <numbers>

namespace throng::ompl {
namespace {

namespace ob = ::ompl::base;
using namespace narrowphase;

/// A square of side 1 in SE2 and a wall of 1 mm at x = 3, 2 m high.
class SquareAndWall : public ::testing::Test {
 protected:
  SquareAndWall() {
    ::ompl::msg::setLogLevel(::ompl::msg::LOG_NONE);
    ob::RealVectorBounds bounds(2);
    bounds.setLow(-10.0), bounds.setHigh(10.0);
    se2_->setBounds(bounds);
    space_->setStateValidityChecker(std::make_shared<ExactStateValidity>(space_, scene_));
    space_->setMotionValidator(std::make_shared<ExactMotionValidator>(space_, scene_));
    space_->setup();
  }

  ob::ScopedState<ob::SE2StateSpace> at(double x, double y, double yaw) const {
    ob::ScopedState<ob::SE2StateSpace> state(space_);
    state->setXY(x, y), state->setYaw(yaw);
    return state;
  }
  bool free(const ob::ScopedState<ob::SE2StateSpace>& from,
            const ob::ScopedState<ob::SE2StateSpace>& to) const {
    return space_->checkMotion(from.get(), to.get());
  }

  std::vector<Convex> square_{convex({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})};
  std::vector<Convex> wall_{convex({{3.0, -1.0}, {3.001, -1.0}, {3.001, 1.0}, {3.0, 1.0}})};
  PartsBvh shape_ = parts_bvh(square_), obstacles_ = parts_bvh(wall_);
  Linkage body_ = free_body(shape_);
  std::vector<LinkPair> pairs_{{2, kWorld}};
  LinkageScene scene_{body_, pairs_, &obstacles_};
  std::shared_ptr<ob::SE2StateSpace> se2_ = std::make_shared<ob::SE2StateSpace>();
  ob::SpaceInformationPtr space_ = std::make_shared<ob::SpaceInformation>(se2_);
};

TEST_F(SquareAndWall, AStateIsValidWhereNothingTouches) {
  EXPECT_TRUE(space_->isValid(at(2.499, 0.0, 0.0).get()));
  EXPECT_FALSE(space_->isValid(at(2.501, 0.0, 0.0).get()));
  EXPECT_FALSE(space_->isValid(at(2.4, 0.0, 0.25 * std::numbers::pi).get())) << "a corner reaches 0.707";
}

TEST_F(SquareAndWall, AWallIsHitHoweverThinAndLongTheWay) {
  EXPECT_FALSE(free(at(-9.0, 0.0, 0.0), at(9.0, 0.0, 0.0)));
  EXPECT_TRUE(free(at(-9.0, 1.501, 0.0), at(9.0, 1.501, 0.0)));
  EXPECT_FALSE(free(at(-9.0, 1.499, 0.0), at(9.0, 1.499, 0.0)));
}

TEST_F(SquareAndWall, TheDiscreteCheckOfTheSameMotionJumpsOverIt) {
  space_->setStateValidityCheckingResolution(0.2);
  space_->setup();
  const ob::DiscreteMotionValidator discrete(space_);
  const auto from = at(-9.0, 0.0, 0.0), to = at(9.0, 0.0, 0.0);
  EXPECT_TRUE(discrete.checkMotion(from.get(), to.get()));
  EXPECT_FALSE(free(from, to));
}

TEST_F(SquareAndWall, AnglesGoTheShortWayRound) {
  const double pi = std::numbers::pi;
  EXPECT_TRUE(free(at(2.49, 0.0, pi - 0.005), at(2.49, 0.0, -pi + 0.005))) << "the long way a corner touches";
  EXPECT_TRUE(space_->isValid(at(2.3, 0.0, 0.6).get()) && space_->isValid(at(2.3, 0.0, 1.0).get()));
  EXPECT_FALSE(free(at(2.3, 0.0, 0.6), at(2.3, 0.0, 1.0))) << "in between a corner touches";
  std::vector<double> end;
  append_end(*se2_, at(0.0, 0.0, 3.0).get(), at(1.0, 2.0, -3.0).get(), end);
  ASSERT_EQ(end.size(), 3u);
  EXPECT_EQ(end[0], 1.0);
  EXPECT_EQ(end[1], 2.0);
  EXPECT_DOUBLE_EQ(end[2], 2.0 * pi - 3.0);
}

TEST_F(SquareAndWall, EveryStateOfAStraightMotionIsWhatOmplInterpolates) {
  ::ompl::RNG random(5);
  for (int i = 0; i < 200; ++i) {
    const auto from =
        at(random.uniformReal(-9, 9), random.uniformReal(-9, 9), random.uniformReal(-3.14, 3.14));
    const auto to = at(random.uniformReal(-9, 9), random.uniformReal(-9, 9), random.uniformReal(-3.14, 3.14));
    std::vector<double> begin, end, between;
    append_values(*se2_, from.get(), begin), append_end(*se2_, from.get(), to.get(), end);
    auto state = at(0.0, 0.0, 0.0);
    se2_->interpolate(from.get(), to.get(), 0.3, state.get());
    append_values(*se2_, state.get(), between);
    EXPECT_NEAR(between[0], begin[0] + 0.3 * (end[0] - begin[0]), 1e-14);
    const double turn = begin[2] + 0.3 * (end[2] - begin[2]) - between[2];
    EXPECT_NEAR(std::remainder(turn, 2.0 * std::numbers::pi), 0.0, 1e-14);
  }
}

TEST_F(SquareAndWall, TheLastValidStateStandsJustBeforeTheContact) {
  auto stop = at(0.0, 0.0, 0.0);
  std::pair<ob::State*, double> last{stop.get(), -1.0};
  EXPECT_FALSE(space_->checkMotion(at(-7.5, 0.0, 0.0).get(), at(8.5, 0.0, 0.0).get(), last));
  EXPECT_LE(last.second, 10.0 / 16.0);
  EXPECT_NEAR(last.second, 10.0 / 16.0, 1e-6);
  EXPECT_NEAR(stop->getX(), 2.5, 2e-5);
  EXPECT_TRUE(space_->isValid(stop.get()));
  EXPECT_TRUE(space_->checkMotion(at(-7.5, 5.0, 0.0).get(), at(8.5, 5.0, 0.0).get(), last));
}

TEST_F(SquareAndWall, TheMotionsAreCounted) {
  const auto& validator = *space_->getMotionValidator();
  free(at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0)), free(at(0.0, 0.0, 0.0), at(9.0, 0.0, 0.0));
  EXPECT_EQ(validator.getValidMotionCount(), 1u);
  EXPECT_EQ(validator.getInvalidMotionCount(), 1u);
}

TEST_F(SquareAndWall, ASpaceWhoseMotionsAreCurvedIsRefused) {
  const auto curved = std::make_shared<ob::SpaceInformation>(std::make_shared<ob::DubinsStateSpace>());
  EXPECT_THROW(ExactMotionValidator(curved, scene_), std::invalid_argument);
}

TEST(ExactMotionValidator, JointsMayBeNumbersOrAngles) {
  const auto joints = std::make_shared<ob::RealVectorStateSpace>(2);
  const auto angle = std::make_shared<ob::SO2StateSpace>();
  const auto both = std::make_shared<ob::CompoundStateSpace>();
  both->addSubspace(joints, 1.0), both->addSubspace(angle, 1.0);
  both->lock();
  ob::State* state = both->allocState();
  auto& parts = *state->as<ob::CompoundState>();
  parts.as<ob::RealVectorStateSpace::StateType>(0)->values[0] = 4.0;
  parts.as<ob::RealVectorStateSpace::StateType>(0)->values[1] = 5.0;
  parts.as<ob::SO2StateSpace::StateType>(1)->value = 1.5;
  std::vector<double> values;
  append_values(*both, state, values);
  both->freeState(state);
  EXPECT_EQ(values, (std::vector{4.0, 5.0, 1.5}));
}

}  // namespace
}  // namespace throng::ompl
