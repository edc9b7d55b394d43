// SPDX-License-Identifier: MIT
#include "sim/crowd/least_crowded.h"

#include <algorithm>
#include <limits>

namespace throng {

namespace {

constexpr double kSlowest = 1e-3;  // m/s: who wants to stand takes the nearest

}  // namespace

LeastCrowded::LeastCrowded(const Scene& scene, const Ways& ways)
    : scene_(scene),
      ways_(ways),
      is_counted_(scene.crowd.goals.size(), false),
      going_(scene.crowd.goals.size()) {
  for (const AgentGroup& group : scene.crowd.groups)
    for (const Leg& leg : group.journey)
      for (std::size_t option = 0; option < leg.capacity.size(); ++option)
        is_counted_[scene.crowd.goal(leg, option)] = true;
}

void LeastCrowded::count(const State& state) {
  const Crowd& crowd = scene_.crowd;
  for (Tally& ways : going_) ways.clear();
  for (std::size_t i = 0; i < state.crowd.stage.size(); ++i) {
    if (state.crowd.option[i] == kUndecided) continue;
    const std::size_t agent = agent_of(scene_, state, crowd.first + i);
    const Leg& leg = crowd.leg(agent, state.crowd.stage[i]);
    const std::uint32_t goal = crowd.goal(leg, state.crowd.option[i]);
    if (!is_counted_[goal]) continue;
    const bool there = state.crowd.place[i] > 0 && leg.kind != Leg::Kind::pass;
    going_[goal].push(there ? 0.0
                            : ways_.to(goal, scene_.bodies.radius[crowd.first + agent])
                                  .distance(state.position[crowd.first + i]));
  }
  for (Tally& ways : going_) ways.settle();
}

std::uint32_t LeastCrowded::choose(const Leg& leg, std::size_t agent, const Vec& place) {
  const double speed = std::max(scene_.crowd.desired_speed[agent], kSlowest);
  double least = std::numeric_limits<double>::infinity(), its_way = 0.0;
  std::uint32_t best = 0;
  const auto is_open = [&](std::uint32_t option) { return ways_.is_open(scene_.crowd.goal(leg, option)); };
  bool any = false;
  for (std::uint32_t option = 0; option < leg.options.size(); ++option) any = any || is_open(option);
  for (std::uint32_t option = 0; option < leg.options.size(); ++option) {
    if (any && !is_open(option)) continue;
    const std::uint32_t goal = scene_.crowd.goal(leg, option);
    const double way = ways_.to(goal, scene_.bodies.radius[scene_.crowd.first + agent]).distance(place);
    const double time = way / speed + static_cast<double>(going_[goal].less_than(way)) / leg.capacity[option];
    if (time < least) least = time, its_way = way, best = option;
  }
  going_[scene_.crowd.goal(leg, best)].add(its_way);
  return best;
}

}  // namespace throng
