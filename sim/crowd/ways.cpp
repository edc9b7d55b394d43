// SPDX-License-Identifier: MIT
#include "sim/crowd/ways.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "sim/input_error.h"

namespace throng {

namespace {

/// Calls f(goal) for each option of each leg.
template <class F>
void for_each_goal(const Crowd& crowd, const Journey& journey, F f) {
  for (const Leg& leg : journey)
    for (std::size_t option = 0; option < leg.options.size(); ++option) f(crowd.goal(leg, option));
}

std::string text(double number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", number);
  return buffer;
}

/// The place as people write it.
std::string text(const Vec& p) {
  return "[" + text(p.x()) + ", " + text(p.y()) + "]";
}

}  // namespace

Ways::Ways(const Scene& scene, const Barriers& barriers) : scene_(scene), goals_(scene.crowd.goals.size()) {
  const Crowd& crowd = scene.crowd;
  std::vector<double> least(goals_.size(), std::numeric_limits<double>::infinity()),
      largest(goals_.size(), 0.0);
  for (const AgentGroup& group : crowd.groups) {
    if (group.count == 0) continue;
    const auto first = scene.bodies.radius.begin() + crowd.first + group.first;
    const auto [low, high] = std::minmax_element(first, first + group.count);
    for_each_goal(crowd, group.journey, [&, low = *low, high = *high](std::uint32_t goal) {
      least[goal] = std::min(least[goal], low), largest[goal] = std::max(largest[goal], high);
    });
  }
  for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
    if (largest[goal] == 0.0) continue;
    const FloorPlan& floor = plan(least[goal], largest[goal], barriers);
    const throng::Goal& its = crowd.goals[goal];
    if (its.phases.empty()) add_phase(goal, {0.0, true, its.region}, floor, barriers);
    for (const GoalPhase& phase : its.phases) add_phase(goal, phase, floor, barriers);
    goals_[goal].now = goals_[goal].phases.data();
    changes_ = changes_ || its.phases.size() > 1;
  }
  expect_ways();
}

void Ways::add_phase(std::uint32_t goal, const GoalPhase& phase, const FloorPlan& plan,
                     const Barriers& barriers) {
  goals_[goal].phases.push_back({Time{scene_.time.dt, phase.from, 1}.steps(), phase.from, phase.is_open,
                                 std::make_unique<DistanceField>(plan, barriers, phase.region),
                                 Inside(phase.region)});
}

void Ways::look(std::int64_t step) {
  if (!changes_) return;
  for (Goal& goal : goals_)
    for (const Phase& phase : goal.phases)
      if (phase.from <= step) goal.now = &phase;
}

const FloorPlan& Ways::plan(double least, double largest, const Barriers& barriers) {
  for (const auto& known : plans_)
    if (known->least == least && known->largest == largest) return known->floor;
  const Region& walkable = scene_.crowd.walkable;
  const Resolution resolution = resolution_for(walkable, barriers, least, largest);
  plans_.push_back(
      std::make_unique<Plan>(Plan{least, largest, floor_plan(walkable, barriers, resolution, 2.0 * least)}));
  return plans_.back()->floor;
}

bool Ways::lead_on(const AgentGroup& group, const Vec& place) const {
  bool all = true;
  for_each_goal(scene_.crowd, group.journey,
                [&](std::uint32_t goal) { all = all && !dead_end(goal, place); });
  return all;
}

/// The goal's first phase to which no way leads from there; none where all do.
const Ways::Phase* Ways::dead_end(std::uint32_t goal, const Vec& place) const {
  for (const Phase& phase : goals_[goal].phases)
    if (!(phase.field->distance(place) < std::numeric_limits<double>::infinity())) return &phase;
  return nullptr;
}

/// Who appears later is checked at a place at random: of his group one must find all ways.
void Ways::expect_ways() const {
  for (const AgentGroup& group : scene_.crowd.groups) {
    std::uint32_t dead_ends = 0, first = 0;
    for (std::uint32_t agent = group.first + group.count; agent-- > group.first;)
      if (!lead_on(group, scene_.bodies.position[scene_.crowd.first + agent])) ++dead_ends, first = agent;
    if (dead_ends > 0 && !(group.entrance && dead_ends < group.count)) fail_at(group, first);
  }
}

void Ways::fail_at(const AgentGroup& group, std::uint32_t agent) const {
  const Crowd& crowd = scene_.crowd;
  const Vec& place = scene_.bodies.position[crowd.first + agent];
  std::string name, when;
  for_each_goal(crowd, group.journey, [&](std::uint32_t goal) {
    const Phase* phase = name.empty() ? dead_end(goal, place) : nullptr;
    if (!phase) return;
    name = crowd.goals[goal].name;
    if (goals_[goal].phases.size() > 1) when = ", as it is open from " + text(phase->time) + " s on";
  });
  throw InputError("agents[" + std::to_string(group.index) + "]: no way wide enough leads from " +
                   text(place) + ", where agent " + std::to_string(crowd.first + agent + 1) +
                   (group.entrance ? " may appear" : " stands") + ", to its goal " + name + when);
}

}  // namespace throng
