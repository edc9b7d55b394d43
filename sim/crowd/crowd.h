// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/crowd/measure.h"
#include "sim/crowd/region.h"

/// The agents of a scene: discs that choose their velocity.
namespace throng {

inline constexpr double kAgentMass = 80.0;  ///< kg, of those whose model has no mass

/// What agents do in an area.
enum class AreaUse : std::uint8_t { none, goal, wait };

struct Area {
  std::string name;
  Region region;
  AreaUse use = AreaUse::none;  ///< by any of their journeys; `wait` also where others only pass
  double opens = 0.0;           ///< s
  double closes = std::numeric_limits<double>::infinity();  ///< s
};

/// What of a goal is open from some time on.
struct GoalPhase {
  double from = 0.0;    ///< s
  bool is_open = true;  ///< any of it; else who goes there waits
  Region region;        ///< what of it is open; all of it where nothing is
};

/// Where agents go: to the nearest of some areas, or to a queue's line.
struct Goal {
  std::string name;                  ///< for messages
  std::vector<std::uint32_t> areas;  ///< rows of Crowd::areas, ascending; none: a queue's
  Region region;                     ///< what is in any of them
  std::vector<GoalPhase> phases;     ///< in their order, the first from 0 s; none: always open
};

inline constexpr std::uint32_t kUndecided = 0xFFFFFFFF;  ///< no option of a leg yet

/// Where agents line up: the first stands at the line's first point, the others behind it along the line.
struct Queue {
  std::string name;
  std::vector<Vec> line;   ///< m, two points or more
  double spacing = 0.6;    ///< m, from place to place
  double service = 0.0;    ///< s, that each takes at the head
  std::uint32_t goal = 0;  ///< row of Crowd::goals: a band along the line
};

/// One part of a journey: what an agent goes for, and what it does there.
struct Leg {
  enum class Kind : std::uint8_t {
    pass,  ///< gets there
    wait,  ///< stands there for some time
    queue  ///< lines up there, and is served
  } kind = Kind::pass;
  std::vector<std::uint32_t> options;  ///< rows of Crowd::goals, of queues of Crowd::queues; each takes one
  std::vector<double> weights;         ///< added up: one is taken by chance; none: by `capacity`
  std::vector<double> capacity;        ///< 1/s: the least crowded is taken; none: there is one option
  std::vector<double> times;           ///< s, of waiting, of each agent of the group; none: for ever
  bool until = false;                  ///< `times` are of the run, not from when they get there

  std::uint32_t first_option() const { return options.size() == 1 ? 0 : kUndecided; }
  friend bool operator==(const Leg&, const Leg&) = default;
};

/// At the end of the last leg the agent leaves.
using Journey = std::vector<Leg>;

/// Where agents appear in the course of time.
struct Entrance {
  Region within;               ///< that holds all of each
  double gap = 0.0;            ///< m, from others and from walls
  std::uint32_t together = 1;  ///< so many are due at once, and appear beside each other where there is room
};

/// Agents of one kind, whose ids follow one another.
struct AgentGroup {
  std::string name;                    ///< that others choose it by; several may share one, or have none
  std::uint32_t model = 0;             ///< row of walking_models()
  std::vector<double> parameters;      ///< of the model
  bool own = false;                    ///< `parameters` are each agent's, one agent's behind the other's
  std::uint32_t first = 0, count = 0;  ///< rows of the crowd
  Journey journey;
  std::optional<Entrance> entrance;  ///< where they appear when due; none: all stand there at the start
  std::uint32_t index = 0;           ///< in the file, for messages

  /// Of one of them, counted from 0.
  std::span<const double> parameters_of(std::uint32_t agent) const {
    const std::size_t each = own ? parameters.size() / count : parameters.size();
    return std::span(parameters).subspan(own ? agent * each : 0, each);
  }
};

/// A row per agent, in the order of their ids.
struct Crowd {
  std::uint32_t first = 0;  ///< row of Scene::bodies of the first of them
  Region walkable;          ///< where agents may be; its edges are walls of the scene too
  std::vector<Area> areas;  ///< by name
  std::vector<AgentGroup> groups;
  std::vector<Goal> goals;  ///< each once
  std::vector<Queue> queues;
  std::vector<std::uint32_t> group;   ///< row of `groups`
  std::vector<double> desired_speed;  ///< m/s
  std::vector<double> due;            ///< s, when it appears; where room is wanting, as soon as there is
  std::vector<double> start;          ///< s, until then it stands
  std::vector<Measure> measures;

  std::size_t size() const { return group.size(); }
  const Leg& leg(std::size_t agent, std::size_t stage) const { return groups[group[agent]].journey[stage]; }
  /// The row of `goals` that one of a leg's options is.
  std::uint32_t goal(const Leg& leg, std::size_t option) const {
    return leg.kind == Leg::Kind::queue ? queues[leg.options[option]].goal : leg.options[option];
  }
};

/// Calls f(row of Crowd::goals) for each option of each leg.
template <class F>
void for_each_goal(const Crowd& crowd, const Journey& journey, F f) {
  for (const Leg& leg : journey)
    for (std::size_t option = 0; option < leg.options.size(); ++option) f(crowd.goal(leg, option));
}

}  // namespace throng
