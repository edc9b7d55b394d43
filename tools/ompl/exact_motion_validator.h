// SPDX-License-Identifier: MIT
#pragma once

#include <ompl/base/SpaceInformation.h>

#include <mutex>
#include <vector>

#include "narrowphase/linkage/check_linkage.h"

/// For planners of the Open Motion Planning Library (Sucan, Moll and Kavraki 2012): motions checked without a
/// resolution.
namespace throng::ompl {

/// Appends the numbers that a state is made of, in the order of its subspaces: RealVector, SO2, SE2 (x, y,
/// yaw) and what is compound of them.
/// Throws std::invalid_argument, which names the space, for others, also for those derived from these.
void append_values(const ::ompl::base::StateSpace& space, const ::ompl::base::State* state,
                   std::vector<double>& values);

/// The numbers at the end of a straight motion that began at `from`: those of `to`, with each angle of SO2
/// reached the short way round, as OMPL interpolates it.
void append_end(const ::ompl::base::StateSpace& space, const ::ompl::base::State* from,
                const ::ompl::base::State* to, std::vector<double>& values);

/// Whether a state is free of collisions: limits of joints are the state space's to keep.
class ExactStateValidity : public ::ompl::base::StateValidityChecker {
 public:
  ExactStateValidity(const ::ompl::base::SpaceInformationPtr& space, const narrowphase::LinkageScene& scene);
  bool isValid(const ::ompl::base::State* state) const override;

 private:
  mutable std::mutex one_at_a_time_;
  mutable narrowphase::LinkageChecker checker_;
  mutable std::vector<double> values_;
};

/// In place of OMPL's DiscreteMotionValidator: a motion is valid if it is proven to be free. What can't be
/// decided, motions within rounding of a touch, counts as invalid; the resolution of the space is not asked.
/// A configuration of the scene's linkage is a state's numbers (`append_values`): a body that moves in SE2 is
/// a linkage of two prismatic joints and a revolute one, see `free_body`. Threads may share one, and wait for
/// each other. The scene's arrays are the caller's, who keeps them.
class ExactMotionValidator : public ::ompl::base::MotionValidator {
 public:
  /// Throws as `append_values`.
  ExactMotionValidator(const ::ompl::base::SpaceInformationPtr& space,
                       const narrowphase::LinkageScene& scene);

  bool checkMotion(const ::ompl::base::State* from, const ::ompl::base::State* to) const override;

  /// Where the motion is not free, `last_valid` gets the fraction before which nothing touches, as near to
  /// the first contact as rounding lets it, and, where it has a state, that state.
  bool checkMotion(const ::ompl::base::State* from, const ::ompl::base::State* to,
                   std::pair<::ompl::base::State*, double>& last_valid) const override;

 private:
  bool counted(bool valid) const;
  void place(const ::ompl::base::State* from, const ::ompl::base::State* to) const;

  mutable std::mutex one_at_a_time_;
  mutable narrowphase::LinkageChecker checker_;
  mutable std::vector<double> from_, to_;
};

/// A body in the plane as a linkage: its values are x, y (m) and yaw (rad).
narrowphase::Linkage free_body(const narrowphase::PartsBvh& shape);

}  // namespace throng::ompl
