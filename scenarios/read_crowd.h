// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scenarios/distribution.h"
#include "scenarios/read.h"

namespace throng::scenarios {

/// One [[agents]] entry.
struct AgentEntry {
  std::uint32_t count = 0;
  Distribution radius, desired_speed;  ///< m, m/s
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
