// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/crowd/measure.h"
#include "sim/crowd/region.h"

/// The agents of a scene: discs that choose their velocity.
namespace throng {

inline constexpr double kAgentMass = 80.0;  ///< kg, as recorded; models have their own

struct Area {
  std::string name;
  Region region;
};

/// Agents of one kind with one goal.
struct AgentGroup {
  std::uint32_t model = 0;         ///< row of walking_models()
  std::vector<double> parameters;  ///< of the model
  std::uint32_t goal = 0;          ///< row of Crowd::areas
  std::uint32_t index = 0;         ///< in the file, for messages
};

/// A row per agent, in the order of their ids.
struct Crowd {
  Region walkable;          ///< where agents may be; its edges are walls of the scene too
  std::vector<Area> areas;  ///< by name
  std::vector<AgentGroup> groups;
  std::vector<std::uint32_t> group;   ///< row of `groups`
  std::vector<double> desired_speed;  ///< m/s
  std::vector<Measure> measures;

  std::size_t size() const { return group.size(); }
};

}  // namespace throng
