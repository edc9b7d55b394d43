// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
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

/// Where agents go: to the nearest of some areas.
struct Goal {
  std::string name;                  ///< for messages
  std::vector<std::uint32_t> areas;  ///< rows of Crowd::areas, ascending
  Region region;                     ///< what is in any of them
};

/// Where agents appear in the course of time.
struct Entrance {
  Region within;     ///< that holds all of each
  double gap = 0.0;  ///< m, from others and from walls
};

/// Agents of one kind, whose ids follow one another.
struct AgentGroup {
  std::uint32_t model = 0;             ///< row of walking_models()
  std::vector<double> parameters;      ///< of the model
  std::uint32_t first = 0, count = 0;  ///< rows of the crowd
  std::optional<Entrance> entrance;    ///< where they appear when due; none: all stand there at the start
  std::uint32_t index = 0;             ///< in the file, for messages
};

/// Goals to be walked to one after the other, rows of Crowd::goals; at the last one the agent leaves.
using Journey = std::vector<std::uint32_t>;

/// A row per agent, in the order of their ids.
struct Crowd {
  Region walkable;          ///< where agents may be; its edges are walls of the scene too
  std::vector<Area> areas;  ///< by name
  std::vector<AgentGroup> groups;
  std::vector<Goal> goals;  ///< each once
  std::vector<Journey> journeys;
  std::vector<std::uint32_t> group;    ///< row of `groups`
  std::vector<std::uint32_t> journey;  ///< row of `journeys`
  std::vector<double> desired_speed;   ///< m/s
  std::vector<double> due;             ///< s, when it appears; where room is wanting, as soon as there is
  std::vector<double> start;           ///< s, until then it stands
  std::vector<Measure> measures;

  std::size_t size() const { return group.size(); }
};

}  // namespace throng
