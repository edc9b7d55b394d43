// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/distribution.h"
#include "scenarios/path.h"
#include "scenarios/read.h"

namespace throng::scenarios {

/// When agents appear: `together` of them each 1 / `rate` * `together` s from `from` on, or at these times.
struct Appearance {
  double rate = 0.0, from = 0.0;  ///< 1/s, s
  std::vector<double> times;      ///< s, ascending; empty: at that rate
  std::uint32_t together = 1;

  double due(std::uint32_t agent) const;  ///< s, of the entry's agents counted from 0
};

/// How long the agents of an entry wait on a leg of their journey.
struct Stay {
  std::size_t leg = 0;
  Distribution time;  ///< s
};

/// One [[agents]] entry.
struct AgentEntry {
  std::uint32_t count = 0;
  Distribution radius, desired_speed, premovement;  ///< m, m/s, s
  std::vector<Distribution> parameters;             ///< of the model
  std::vector<Stay> stays;
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

/// When areas open and close. Call it after `read_areas`.
void read_opening(const toml::table& root, Scene& scene, Report& report);

/// Gives the goals their phases, and reports areas that open or close and are no goals, or to wait in. Call
/// it after `read_agents`.
void settle_opening(const toml::table& root, Scene& scene, Report& report);

/// Queues by name, and the goals that they are. Call it after `read_areas`.
void read_queues(const toml::table& root, Scene& scene, Report& report);

/// Cuts static bodies out of the floor that agents walk on, and reports dynamic ones, which they can't bear
/// yet. Expects all bodies placed.
void add_bodies_to_floor(std::span<const Entry> entries, Scene& scene, Report& report);

/// Reports queues in which nobody could stand. Expects all walls in the scene.
void check_queues(const toml::table& root, const Scene& scene, Report& report);

/// Warns of what won't happen as the file says it: measures, agents and openings after the end, agents who
/// never set out, goals and places that hardly have any floor, bodies that never move and yet are no walls.
/// Expects all in the scene.
void check_crowd(const toml::table& root, std::span<const Entry> bodies, std::span<const AgentEntry> agents,
                 const Scene& scene, Report& report);

/// Row of the area of this name; behind the last one where there is none.
std::uint32_t area_row(const std::string& name, const Scene& scene);

/// Where the agents of an entry go: its legs, but for the times that agents wait, and of which legs these
/// are. Call it after `read_queues`.
std::pair<Journey, std::vector<Stay>> read_journey(const toml::table& agents, const Path& path, Scene& scene,
                                                   Report& report);

/// The entries, and their groups in scene.crowd. Call it after `read_queues`.
std::vector<AgentEntry> read_agents(const toml::table& root, Scene& scene, Report& report);

/// What of a measured area is walkable.
void find_ground(const Region& walkable, Measure& measure);

/// What is measured of them. Call it after `read_agents`.
void read_measures(const toml::table& root, Scene& scene, Report& report);

/// Makes the agents the last of the bodies: radii, speeds and places, none of which overlaps another agent or
/// a wall where it is random: those find theirs after all who have a place of their own. Reports entries for
/// which there is no room, agents that don't stand on the walkable area, and steps that are too long for a
/// model.
void place_agents(std::span<const AgentEntry> entries, Scene& scene, Report& report);

}  // namespace throng::scenarios
