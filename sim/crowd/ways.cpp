// SPDX-License-Identifier: MIT
#include "sim/crowd/ways.h"

#include <algorithm>
#include <cstdio>

#include "sim/crowd/entrance.h"
#include "sim/crowd/room.h"
#include "sim/crowd/ways_size.h"

namespace throng {

namespace {

constexpr double kSurely = 1.0 + 1e-9;  // so much farther, squared, rounding makes nothing
constexpr int kEntranceSteps = 10;      // as many an agent looks round an empty entrance for a way

std::string text(double number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", number);
  return buffer;
}

/// The place as people write it.
std::string text(const Vec& p) {
  return "[" + text(p.x()) + ", " + text(p.y()) + "]";
}

std::string gigabytes(double bytes) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g GB", bytes / 1e9);
  return buffer;
}

/// A group that has the goal.
const AgentGroup& group_with(const Crowd& crowd, std::uint32_t wanted) {
  return *std::ranges::find_if(crowd.groups, [&](const AgentGroup& group) {
    bool has = false;
    for_each_goal(crowd, group.journey, [&](std::uint32_t goal) { has = has || goal == wanted; });
    return has && group.count > 0;
  });
}

void expect_memory(const Crowd& crowd, const WaysSize& size) {
  if (size.bytes <= kMostWaysBytes) return;
  throw NoWay(group_with(crowd, size.worst).index,
              "the ways of all agents to their goals take " + std::to_string(size.fields) +
                  " distance fields, " + gigabytes(size.bytes) + ", and may take at most " +
                  gigabytes(kMostWaysBytes) + "; goal " + crowd.goals[size.worst].name + " alone takes " +
                  std::to_string(size.of_worst) +
                  ", one for each class of radii whenever any of it opens or closes: take fewer goals, "
                  "times in [open] or radii, or a smaller `walkable`");
}

}  // namespace

std::string agent_name(const Scene& scene, std::uint32_t row) {
  const std::uint32_t agent = row - scene.crowd.first;
  const AgentGroup& group = scene.crowd.groups[scene.crowd.group[agent]];
  return "agent " + std::to_string(agent - group.first + 1) + " of " + std::to_string(group.count) + " (id " +
         std::to_string(row + 1) + ", radius " + text(scene.bodies.radius[row]) + " m)";
}

Ways::Ways(const Scene& scene, const Barriers& barriers)
    : scene_(scene), barriers_(barriers), goals_(scene.crowd.goals.size()) {
  const Crowd& crowd = scene.crowd;
  GoalSizes sizes = sizes_by_goal(scene, barriers);
  expect_memory(scene.crowd, ways_size(scene, barriers, sizes));
  for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
    if (sizes[goal].empty()) continue;
    goals_[goal].sizes = std::move(sizes[goal]);
    const throng::Goal& its = crowd.goals[goal];
    goals_[goal].phases.reserve(its.phases.size() + 1);
    if (its.phases.empty()) add_phase(goal, {0.0, true, its.region});
    for (const GoalPhase& phase : its.phases) add_phase(goal, phase);
    goals_[goal].now = goals_[goal].phases.data();
    changes_ = changes_ || its.phases.size() > 1;
  }
  expect_ways();
}

void Ways::add_phase(std::uint32_t goal, const GoalPhase& phase) {
  std::vector<DistanceField> fields;
  for (const SizeClass& size : goals_[goal].sizes)
    fields.emplace_back(plan(size.largest), barriers_, phase.region);
  std::vector<Strip> strips = this->strips(goal, phase);
  const Eigen::AlignedBox2d reach = this->reach(goal, phase, !strips.empty());
  goals_[goal].phases.push_back({Time{scene_.time.dt, phase.from, 1}.steps(), phase.from, phase.is_open,
                                 std::move(fields), Inside(phase.region), std::move(strips), reach});
}

/// Who is at a strip is at most his width from it.
Eigen::AlignedBox2d Ways::reach(std::uint32_t goal, const GoalPhase& phase, bool has_strips) const {
  Eigen::AlignedBox2d box = bounds(phase.region);
  const double beside = has_strips ? kSurely * 2.0 * goals_[goal].sizes.back().largest : 0.0;
  box.min().array() -= beside, box.max().array() += beside;
  return box;
}

/// Of the areas that are open.
std::vector<Ways::Strip> Ways::strips(std::uint32_t goal, const GoalPhase& phase) const {
  const double widest = goals_[goal].sizes.back().largest;
  std::vector<Strip> strips;
  for (const std::uint32_t row : scene_.crowd.goals[goal].areas) {
    const Area& area = scene_.crowd.areas[row];
    if (area.opens > phase.from || area.closes <= phase.from) continue;
    const double largest = largest_with_room(area.region, scene_.crowd.walkable, barriers_, widest);
    const double two = 0.5 * span(area.region);
    if (std::min(largest, two) < widest) strips.push_back({area.region, bounds(area.region), largest, two});
  }
  return strips;
}

bool Ways::is_at_strip(std::uint32_t goal, double radius, const Vec& p, bool stood) const {
  return std::ranges::any_of(goals_[goal].now->strips, [&](const Strip& strip) {
    if (strip.box.squaredExteriorDistance(p) > kSurely * 4.0 * radius * radius) return false;
    if (radius <= strip.largest && !(stood && radius > strip.two)) return false;
    const Vec nearest = nearest_on_border(strip.region, p);
    return (nearest - p).squaredNorm() <= 4.0 * radius * radius && !barriers_.block(p, nearest);
  });
}

void Ways::look(std::int64_t step) {
  if (!changes_) return;
  for (Goal& goal : goals_)
    for (const Phase& phase : goal.phases)
      if (phase.from <= step) goal.now = &phase;
}

const FloorPlan& Ways::plan(double largest) {
  for (const auto& known : plans_)
    if (known->largest == largest) return known->floor;
  const Region& walkable = scene_.crowd.walkable;
  const Resolution resolution = resolution_for(walkable, barriers_, largest);
  plans_.push_back(
      std::make_unique<Plan>(Plan{largest, floor_plan(walkable, barriers_, resolution, closed_to(largest))}));
  return plans_.back()->floor;
}

bool Ways::lead_on(const AgentGroup& group, double radius, const Vec& place) const {
  bool all = true;
  for_each_goal(scene_.crowd, group.journey,
                [&](std::uint32_t goal) { all = all && !dead_end(goal, radius, place); });
  return all;
}

/// The goal's first phase to which no way leads from there; none where all do.
std::optional<std::size_t> Ways::dead_end(std::uint32_t goal, double radius, const Vec& place) const {
  const Goal& its = goals_[goal];
  const std::size_t size = its.size(radius);
  for (std::size_t phase = 0; phase < its.phases.size(); ++phase)
    if (!(its.phases[phase].fields[size].distance(place) < kFree)) return phase;
  return std::nullopt;
}

/// Whether ways lead him on from his place, or, who appears later, from any of many places of the entrance.
bool Ways::lead_on_from_any(const AgentGroup& group, std::uint32_t agent) const {
  const double radius = scene_.bodies.radius[scene_.crowd.first + agent];
  if (lead_on(group, radius, scene_.bodies.position[scene_.crowd.first + agent])) return true;
  if (!group.entrance) return false;
  const Sampler entrance(group.entrance->within, radius);
  Standing nobody;
  for (int step = 0; step < kEntranceSteps; ++step)
    if (free_place(scene_, barriers_, nobody, entrance, agent, step, std::nullopt,
                   [&](const Vec& p) { return lead_on(group, radius, p); }))
      return true;
  return false;
}

/// Who appears isn't asked where a wider one of his group has found a way.
void Ways::expect_ways() const {
  for (const AgentGroup& group : scene_.crowd.groups) {
    double widest = 0.0;
    for (std::uint32_t agent = group.first; agent < group.first + group.count; ++agent) {
      const double radius = scene_.bodies.radius[scene_.crowd.first + agent];
      if (group.entrance && radius <= widest) continue;
      if (!lead_on_from_any(group, agent)) fail_at(group, agent);
      widest = std::max(widest, radius);
    }
  }
}

/// Why there is no way, in words.
std::string Ways::why(std::uint32_t goal, std::size_t phase, const AgentGroup& group,
                      std::uint32_t agent) const {
  const std::uint32_t row = scene_.crowd.first + agent;
  const Goal& its = goals_[goal];
  const double radius = scene_.bodies.radius[row];
  const std::string name = scene_.crowd.goals[goal].name;
  const std::string when =
      its.phases.size() > 1 ? ", as it is open from " + text(its.phases[phase].time) + " s on" : "";
  if (!its.phases[phase].fields[its.size(radius)].leads_from_anywhere())
    return "its goal " + name + when + " is nowhere on the floor that " + agent_name(scene_, row) +
           ", or any other as wide, gets to";
  const std::string where =
      group.entrance ? "anywhere that " + agent_name(scene_, row) + " may appear"
                     : text(scene_.bodies.position[row]) + ", where " + agent_name(scene_, row) + " stands,";
  return "no way wide enough leads from " + where + " to its goal " + name + when;
}

void Ways::fail_at(const AgentGroup& group, std::uint32_t agent) const {
  const std::uint32_t row = scene_.crowd.first + agent;
  std::string reason;
  for_each_goal(scene_.crowd, group.journey, [&](std::uint32_t goal) {
    if (!reason.empty()) return;
    if (const auto phase = dead_end(goal, scene_.bodies.radius[row], scene_.bodies.position[row]))
      reason = why(goal, *phase, group, agent);
  });
  throw NoWay(group.index, reason);
}

}  // namespace throng
