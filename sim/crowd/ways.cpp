// SPDX-License-Identifier: MIT
#include "sim/crowd/ways.h"

#include <algorithm>
#include <cstdio>

#include "sim/input_error.h"

namespace throng {

namespace {

/// Calls f(goal) for each option of each leg.
template <class F>
void for_each_goal(const Crowd& crowd, const Journey& journey, F f) {
  for (const Leg& leg : journey)
    for (std::size_t option = 0; option < leg.options.size(); ++option) f(crowd.goal(leg, option));
}

/// Of all who have each goal.
std::vector<std::vector<double>> radii_by_goal(const Scene& scene) {
  std::vector<std::vector<double>> radii(scene.crowd.goals.size());
  for (const AgentGroup& group : scene.crowd.groups) {
    const auto first = scene.bodies.radius.begin() + scene.crowd.first + group.first;
    for_each_goal(scene.crowd, group.journey, [&](std::uint32_t goal) {
      radii[goal].insert(radii[goal].end(), first, first + group.count);
    });
  }
  return radii;
}

/// Those that some agents get through and others don't.
std::vector<double> narrow_passages(const Scene& scene, const Barriers& barriers) {
  const auto first = scene.bodies.radius.begin() + scene.crowd.first;
  const auto [least, largest] =
      std::minmax_element(first, first + static_cast<std::ptrdiff_t>(scene.crowd.size()));
  if (scene.crowd.size() == 0 || *least == *largest) return {};
  return passages(scene.crowd.walkable, barriers, closed_to(*least), closed_to(*largest));
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
  std::vector<std::vector<double>> radii = radii_by_goal(scene);
  const std::vector<double> narrow = narrow_passages(scene, barriers);
  for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
    if (radii[goal].empty()) continue;
    goals_[goal].sizes = size_classes(std::move(radii[goal]), narrow);
    const throng::Goal& its = crowd.goals[goal];
    goals_[goal].phases.reserve(its.phases.size() + 1);
    if (its.phases.empty()) add_phase(goal, {0.0, true, its.region}, barriers);
    for (const GoalPhase& phase : its.phases) add_phase(goal, phase, barriers);
    goals_[goal].now = goals_[goal].phases.data();
    changes_ = changes_ || its.phases.size() > 1;
  }
  expect_ways();
}

void Ways::add_phase(std::uint32_t goal, const GoalPhase& phase, const Barriers& barriers) {
  std::vector<DistanceField> fields;
  for (const SizeClass& size : goals_[goal].sizes)
    fields.emplace_back(plan(size.largest, barriers), barriers, phase.region);
  goals_[goal].phases.push_back({Time{scene_.time.dt, phase.from, 1}.steps(), phase.from, phase.is_open,
                                 std::move(fields), Inside(phase.region)});
}

void Ways::look(std::int64_t step) {
  if (!changes_) return;
  for (Goal& goal : goals_)
    for (const Phase& phase : goal.phases)
      if (phase.from <= step) goal.now = &phase;
}

const FloorPlan& Ways::plan(double largest, const Barriers& barriers) {
  for (const auto& known : plans_)
    if (known->largest == largest) return known->floor;
  const Region& walkable = scene_.crowd.walkable;
  const Resolution resolution = resolution_for(walkable, barriers, largest, largest);
  plans_.push_back(
      std::make_unique<Plan>(Plan{largest, floor_plan(walkable, barriers, resolution, closed_to(largest))}));
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

/// Who appears later is checked at a place at random: of his group one must find all ways.
void Ways::expect_ways() const {
  for (const AgentGroup& group : scene_.crowd.groups) {
    std::uint32_t dead_ends = 0, first = 0;
    for (std::uint32_t agent = group.first + group.count; agent-- > group.first;)
      if (!lead_on(group, scene_.bodies.radius[scene_.crowd.first + agent],
                   scene_.bodies.position[scene_.crowd.first + agent]))
        ++dead_ends, first = agent;
    if (dead_ends > 0 && !(group.entrance && dead_ends < group.count)) fail_at(group, first);
  }
}

void Ways::fail_at(const AgentGroup& group, std::uint32_t agent) const {
  const Crowd& crowd = scene_.crowd;
  const Vec& place = scene_.bodies.position[crowd.first + agent];
  const double radius = scene_.bodies.radius[crowd.first + agent];
  std::string name, when;
  for_each_goal(crowd, group.journey, [&](std::uint32_t goal) {
    const std::optional<std::size_t> phase = name.empty() ? dead_end(goal, radius, place) : std::nullopt;
    if (!phase) return;
    const std::vector<Phase>& phases = goals_[goal].phases;
    name = crowd.goals[goal].name;
    if (phases.size() > 1) when = ", as it is open from " + text(phases[*phase].time) + " s on";
  });
  throw InputError("agents[" + std::to_string(group.index) + "]: no way wide enough leads from " +
                   text(place) + ", where agent " + std::to_string(crowd.first + agent + 1) +
                   (group.entrance ? " may appear" : " stands") + ", to its goal " + name + when);
}

}  // namespace throng
