// SPDX-License-Identifier: MIT
#include "sim/crowd/ways_size.h"

#include <algorithm>
#include <map>

#include "sim/crowd/floor_plan.h"

namespace throng {

namespace {

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

}  // namespace

GoalSizes sizes_by_goal(const Scene& scene, const Barriers& barriers) {
  const std::vector<double> narrow = narrow_passages(scene, barriers);
  GoalSizes sizes;
  for (std::vector<double>& radii : radii_by_goal(scene))
    sizes.push_back(radii.empty() ? std::vector<SizeClass>() : size_classes(std::move(radii), narrow));
  return sizes;
}

WaysSize ways_size(const Scene& scene, const Barriers& barriers, const GoalSizes& sizes) {
  WaysSize all;
  std::map<double, double> nodes;  // by the largest radius that walks there
  double most = 0.0;               // bytes
  for (std::uint32_t goal = 0; goal < sizes.size(); ++goal) {
    const std::size_t phases = std::max<std::size_t>(scene.crowd.goals[goal].phases.size(), 1);
    const std::size_t fields = phases * sizes[goal].size();
    double bytes = 0.0;
    for (const SizeClass& size : sizes[goal]) {
      const auto [plan, is_new] = nodes.try_emplace(size.largest, 0.0);
      if (is_new) {
        const Region& floor = scene.crowd.walkable;
        plan->second = plan_nodes(floor, resolution_for(floor, barriers, size.largest));
        all.bytes += plan->second * sizeof(Footing);
      }
      bytes += static_cast<double>(phases) * plan->second * sizeof(float);
    }
    all.fields += fields, all.bytes += bytes;
    if (bytes > most) most = bytes, all.worst = goal, all.of_worst = fields;
  }
  all.plans = nodes.size();
  return all;
}

}  // namespace throng
