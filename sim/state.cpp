// SPDX-License-Identifier: MIT
#include "sim/state.h"

#include <bit>
#include <numeric>

namespace throng {

namespace {

/// One word more in a running hash, as a lane of XXH64 takes it (Collet 2012).
std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  return std::rotl(hash + word * 0xc2b2ae3d27d4eb4fULL, 31) * 0x9e3779b185ebca87ULL;
}

/// Every bit of the result depends on every bit of the hash: MurmurHash3's finaliser (Appleby 2011).
std::uint64_t finished(std::uint64_t hash) {
  hash ^= hash >> 33;
  hash *= 0xff51afd7ed558ccdULL;
  hash ^= hash >> 33;
  hash *= 0xc4ceb9fe1a85ec53ULL;
  return hash ^ (hash >> 33);
}

/// The bits of a number, with one zero.
std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x + 0.0);
}

}  // namespace

State initial_state(const Scene& scene) {
  const Bodies& bodies = scene.bodies;
  State state;
  const auto add = [&](std::size_t row) {
    state.id.push_back(static_cast<std::uint32_t>(row + 1));
    state.position.push_back(bodies.position[row]);
    state.angle.push_back(bodies.angle[row]);
    state.velocity.push_back(bodies.velocity[row]);
    state.spin.push_back(bodies.spin[row]);
  };
  state.sensed.resize(scene.sensors.size());
  const Crowd& crowd = scene.crowd;
  for (std::size_t row = 0; row < bodies.size(); ++row)
    if (crowd.size() == 0 || !crowd.groups[crowd.group[row]].entrance) add(row);
  if (crowd.size() == 0) return state;
  state.crowd.stand = state.position;
  state.crowd.stand_step.resize(state.id.size());
  state.crowd.stage.resize(state.id.size());
  state.crowd.measured.resize(crowd.measures.size());
  for (const AgentGroup& group : crowd.groups)
    state.crowd.waiting.push_back(group.entrance ? group.count : 0);
  return state;
}

std::uint64_t waiting(const CrowdState& crowd) {
  return std::accumulate(crowd.waiting.begin(), crowd.waiting.end(), std::uint64_t{0});
}

bool fits(const State& state, const Scene& scene) {
  const CrowdState& crowd = state.crowd;
  const Crowd& of = scene.crowd;
  const bool agents = of.size() > 0;
  const std::size_t rows = state.id.size(), arrived = static_cast<std::size_t>(crowd.arrived);
  if (state.sensed.size() != scene.sensors.size() || rows + arrived + waiting(crowd) != scene.bodies.size() ||
      crowd.stand.size() != (agents ? rows : 0) || crowd.waiting.size() != (agents ? of.groups.size() : 0) ||
      crowd.measured.size() != (agents ? of.measures.size() : 0) || (arrived > 0 && !agents))
    return false;
  for (std::size_t group = 0; group < crowd.waiting.size(); ++group)
    if (crowd.waiting[group] > (of.groups[group].entrance ? of.groups[group].count : 0)) return false;
  const auto is_waiting = [&](std::size_t agent) {
    const AgentGroup& group = of.groups[of.group[agent]];
    return agent >= group.first + group.count - crowd.waiting[of.group[agent]];
  };
  for (std::size_t row = 0; row < crowd.stage.size(); ++row)
    if (is_waiting(state.id[row] - std::size_t{1}) ||
        crowd.stage[row] >= of.journeys[of.journey[state.id[row] - 1]].size())
      return false;
  return true;
}

std::uint64_t hash(const State& state) {
  std::uint64_t sum = 0;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    std::uint64_t one = mix(0x7468726f6e673032ULL, state.id[row]);
    for (double x : {state.position[row].x(), state.position[row].y(), state.angle[row],
                     state.velocity[row].x(), state.velocity[row].y(), state.spin[row]})
      one = mix(one, bits(x));
    sum += finished(one);
  }
  return finished(mix(mix(sum, state.id.size()), static_cast<std::uint64_t>(state.step)));
}

}  // namespace throng
