// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/crowd/size_classes.h"
#include "sim/scene.h"

/// How many distance fields the ways of a scene are, and what memory they take: known before any is made.
namespace throng {

/// The classes of the radii of all who have each goal, as Crowd::goals; none where no agent goes.
using GoalSizes = std::vector<std::vector<SizeClass>>;

/// O(agents log agents + barriers near one another).
GoalSizes sizes_by_goal(const Scene& scene, const Barriers& barriers);

struct WaysSize {
  std::size_t fields = 0;   ///< one for each goal, each phase of its opening and each class of radii
  std::size_t plans = 0;    ///< floor plans that they are on, one for each largest radius of a class
  double bytes = 0.0;       ///< of both
  std::uint32_t worst = 0;  ///< row of Crowd::goals: that whose fields take the most; of equal ones the first
  std::size_t of_worst = 0;  ///< fields of that goal
};

/// O(goals + plans barriers near one another).
WaysSize ways_size(const Scene& scene, const Barriers& barriers, const GoalSizes& sizes);

inline constexpr double kMostWaysBytes = 4e9;  ///< beyond that a scene is refused

}  // namespace throng
