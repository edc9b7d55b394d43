// SPDX-License-Identifier: MIT
#include "tools/ompl/exact_motion_validator.h"

#include <ompl/base/spaces/SE2StateSpace.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <typeinfo>

namespace throng::ompl {

namespace ob = ::ompl::base;

namespace {

/// The angle at the end of the short way from one to the other.
double end_of_short_way(double from, double to) {
  const double way = to - from;
  if (std::abs(way) <= std::numbers::pi) return to;
  return from + way - std::copysign(2.0 * std::numbers::pi, way);
}

/// Of exactly this class: one derived from it may interpolate otherwise, as Dubins' cars do.
template <class Space>
bool is(const ob::StateSpace& space) {
  return typeid(space) == typeid(Space);
}

/// Says at the door what else the first question would say.
void expect_understood(const ob::StateSpace& space) {
  ob::State* state = space.allocState();
  std::vector<double> values;
  try {
    append_values(space, state, values);
  } catch (...) {
    space.freeState(state);
    throw;
  }
  space.freeState(state);
}

}  // namespace

void append_end(const ob::StateSpace& space, const ob::State* from, const ob::State* to,
                std::vector<double>& values) {
  if (is<ob::CompoundStateSpace>(space) || is<ob::SE2StateSpace>(space)) {
    const auto& whole = *space.as<ob::CompoundStateSpace>();
    const auto *begin = from->as<ob::CompoundState>(), *end = to->as<ob::CompoundState>();
    for (unsigned i = 0; i < whole.getSubspaceCount(); ++i)
      append_end(*whole.getSubspace(i), begin->components[i], end->components[i], values);
  } else if (is<ob::RealVectorStateSpace>(space)) {
    const double* numbers = to->as<ob::RealVectorStateSpace::StateType>()->values;
    values.insert(values.end(), numbers, numbers + space.getDimension());
  } else if (is<ob::SO2StateSpace>(space)) {
    values.push_back(end_of_short_way(from->as<ob::SO2StateSpace::StateType>()->value,
                                      to->as<ob::SO2StateSpace::StateType>()->value));
  } else {
    throw std::invalid_argument(
        "state space " + space.getName() +
        ": straight motions are those of RealVector, SO2, SE2 and what is compound of them");
  }
}

void append_values(const ob::StateSpace& space, const ob::State* state, std::vector<double>& values) {
  append_end(space, state, state, values);
}

ExactStateValidity::ExactStateValidity(const ob::SpaceInformationPtr& space,
                                       const narrowphase::LinkageScene& scene)
    : StateValidityChecker(space), checker_(scene) {}

bool ExactStateValidity::isValid(const ob::State* state) const {
  const std::lock_guard lock(one_at_a_time_);
  values_.clear();
  append_values(*si_->getStateSpace(), state, values_);
  return !checker_.contact(values_);
}

ExactMotionValidator::ExactMotionValidator(const ob::SpaceInformationPtr& space,
                                           const narrowphase::LinkageScene& scene)
    : MotionValidator(space), checker_(scene) {
  expect_understood(*space->getStateSpace());
}

bool ExactMotionValidator::counted(bool valid) const {
  ++(valid ? valid_ : invalid_);
  return valid;
}

void ExactMotionValidator::place(const ob::State* from, const ob::State* to) const {
  const ob::StateSpace& space = *si_->getStateSpace();
  from_.clear(), to_.clear();
  append_values(space, from, from_);
  append_end(space, from, to, to_);
}

bool ExactMotionValidator::checkMotion(const ob::State* from, const ob::State* to) const {
  const std::lock_guard lock(one_at_a_time_);
  place(from, to);
  return counted(checker_.check_motion(from_, to_).verdict == narrowphase::Verdict::free);
}

bool ExactMotionValidator::checkMotion(const ob::State* from, const ob::State* to,
                                       std::pair<ob::State*, double>& last_valid) const {
  const std::lock_guard lock(one_at_a_time_);
  place(from, to);
  const narrowphase::LinkageAnswer answer = checker_.first_contact(from_, to_);
  if (answer.verdict == narrowphase::Verdict::free) return counted(true);
  last_valid.second = answer.from;
  if (last_valid.first != nullptr)
    si_->getStateSpace()->interpolate(from, to, last_valid.second, last_valid.first);
  return counted(false);
}

narrowphase::Linkage free_body(const narrowphase::PartsBvh& shape) {
  using narrowphase::Joint;
  narrowphase::Linkage body(3);
  body[0].joint = body[1].joint = Joint::prismatic;
  body[1].parent = 0, body[1].axis = {0.0, 1.0};
  body[2].parent = 1, body[2].shape = &shape;
  return body;
}

}  // namespace throng::ompl
