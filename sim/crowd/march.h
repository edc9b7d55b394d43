// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/crowd/floor_plan.h"

namespace throng {

/// The distance of a node, known beforehand.
struct Seed {
  std::size_t node;
  double distance;  ///< m
};

inline constexpr double kUnreached = std::numeric_limits<double>::infinity();  ///< m, where no way leads

/// Distances (m) of all nodes from the seeds along ways over the plan, infinite where none leads: first over
/// free nodes, then from these over the others as far as twice the clearance, never across a barrier: next to
/// free ground as the ways there go on, deeper at two thirds of the speed and straight back to it. O(n log
/// n); allocates about 16 bytes a node.
std::vector<float> march(const FloorPlan& plan, const Barriers& barriers, std::span<const Seed> seeds);

}  // namespace throng
