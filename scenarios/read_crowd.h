// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/distribution.h"
#include "scenarios/read.h"

namespace throng::scenarios {

/// When agents appear: `together` of them each 1 / `rate` * `together` s from `from` on, or at these times.
struct Appearance {
  double rate = 0.0, from = 0.0;  ///< 1/s, s
  std::vector<double> times;      ///< s, ascending; empty: at that rate
  std::uint32_t together = 1;

  double due(std::uint32_t agent) const;  ///< s, of the entry's agents counted from 0
};

/// One [[agents]] entry.
struct AgentEntry {
  std::uint32_t count = 0;
  Distribution radius, desired_speed, premovement;  ///< m, m/s, s
  std::vector<std::uint32_t> journeys;              ///< rows of Crowd::journeys, of which each agent has one
  std::vector<double> weights;                      ///< of each, added up
  std::optional<Appearance> appears;
  bool random = false;
  Vec at{0.0, 0.0};  ///< m
  Region within;     ///< of random places
  double gap = 0.0;  ///< m
  std::string path;  ///< "agents[2]"
  const toml::node* node = nullptr;
};

/// walkable and areas; the edges of the walkable area become walls. Call it after `read_walls`.
void read_areas(const toml::table& root, Scene& scene, Report& report);

/// The entries, and their groups in scene.crowd. Call it after `read_areas`.
std::vector<AgentEntry> read_agents(const toml::table& root, Scene& scene, Report& report);

/// What is measured of them. Call it after `read_agents`.
void read_measures(const toml::table& root, Scene& scene, Report& report);

/// Makes the agents the last of the bodies: radii, speeds and places, none of which overlaps another agent or
/// a wall where it is random. Reports entries for which there is no room, agents that don't stand on the
/// walkable area, and steps that are too long for a model.
void place_agents(std::span<const AgentEntry> entries, Scene& scene, Report& report);

}  // namespace throng::scenarios
