// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "tools/ompl/exact_motion_validator.h"

/// What the demonstration plans for.
namespace throng::ompl {

/// A robot among obstacles, and where it is to go. Stays where it is.
struct Problem {
  std::string name;
  bool in_se2;       ///< a body that moves freely; else joints, each within its limits
  double low, high;  ///< m, where the body may be; rad, how far a joint may turn
  std::vector<double> start, goal;

  std::deque<std::vector<narrowphase::Convex>> parts;  ///< of the obstacles, then of the robot's shapes
  std::deque<narrowphase::PartsBvh> shapes;
  narrowphase::Linkage robot;
  std::vector<narrowphase::LinkPair> pairs;

  Problem() = default;
  Problem(const Problem&) = delete;
  narrowphase::LinkageScene scene() const { return {robot, pairs, &shapes[0]}; }
};

/// An angle bracket in a maze of rooms whose walls are 2 cm thick.
void make_maze(Problem& problem);

/// An arm of six links between posts of 1 cm.
void make_arm(Problem& problem);

}  // namespace throng::ompl
