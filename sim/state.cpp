// SPDX-License-Identifier: MIT
#include "sim/state.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "sim/plan.h"

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

void add_agent(const Scene& scene, State& state, std::uint32_t agent, const Vec& place) {
  state.id.push_back(scene.crowd.first + agent + 1);
  state.position.push_back(place), state.velocity.push_back(Vec(0.0, 0.0));
  state.angle.push_back(0.0), state.spin.push_back(0.0);
  CrowdState& crowd = state.crowd;
  crowd.stand.push_back(place), crowd.stand_step.push_back(state.step);
  crowd.stage.push_back(0), crowd.option.push_back(scene.crowd.leg(agent, 0).first_option());
  crowd.place.push_back(0), crowd.since.push_back(state.step);
  crowd.spot.push_back(place);
  crowd.halt.push_back(place), crowd.halt_step.push_back(state.step);
}

State placed_bodies(const Scene& scene) {
  const Bodies& bodies = scene.bodies;
  State state;
  for (std::size_t row = 0; row < bodies.size() - scene.crowd.size(); ++row) {
    state.id.push_back(static_cast<std::uint32_t>(row + 1));
    state.position.push_back(bodies.position[row]);
    state.angle.push_back(bodies.angle[row]);
    state.velocity.push_back(bodies.velocity[row]);
    state.spin.push_back(bodies.spin[row]);
  }
  return state;
}

State initial_state(const Scene& scene) {
  const Bodies& bodies = scene.bodies;
  const Crowd& crowd = scene.crowd;
  State state = placed_bodies(scene);
  state.sensed.resize(scene.sensors.size());
  if (plan_for(scene).sleep) {
    state.sleep.calm.resize(bodies.size(), 0);
    state.sleep.squared_speed.resize(bodies.size(), 0.0);
    state.sleep.island.resize(bodies.size(), 0);
  }
  if (crowd.size() == 0) return state;
  for (std::uint32_t agent = 0; agent < crowd.size(); ++agent)
    if (!crowd.groups[crowd.group[agent]].entrance)
      add_agent(scene, state, agent, bodies.position[crowd.first + agent]);
  state.crowd.measured.resize(crowd.measures.size());
  for (const AgentGroup& group : crowd.groups)
    state.crowd.waiting.push_back(group.entrance ? group.count : 0);
  return state;
}

std::size_t asleep(const SleepState& sleep) {
  return sleep.island.size() - static_cast<std::size_t>(std::ranges::count(sleep.island, 0u));
}

std::uint64_t waiting(const CrowdState& crowd) {
  return std::accumulate(crowd.waiting.begin(), crowd.waiting.end(), std::uint64_t{0});
}

namespace {

/// Whether the agent in that row of the crowd is one who has appeared, on a leg of its journey and an option
/// of that.
bool is_on_its_way(const State& state, const Scene& scene, std::size_t row) {
  const Crowd& of = scene.crowd;
  const CrowdState& crowd = state.crowd;
  const std::size_t agent = agent_of(scene, state, of.first + row);
  if (agent >= of.size()) return false;
  const AgentGroup& group = of.groups[of.group[agent]];
  if (agent >= group.first + group.count - crowd.waiting[of.group[agent]]) return false;
  if (crowd.stage[row] >= group.journey.size()) return false;
  const Leg& leg = group.journey[crowd.stage[row]];
  if (crowd.option[row] == kUndecided) return leg.options.size() > 1 && crowd.place[row] == 0;
  if (crowd.option[row] >= leg.options.size()) return false;
  const bool may_wait =
      leg.kind == Leg::Kind::wait || !of.goals[of.goal(leg, crowd.option[row])].phases.empty();
  return leg.kind == Leg::Kind::queue || crowd.place[row] <= (may_wait ? 1u : 0u);
}

/// Whether those who have left are agents who have appeared.
bool have_appeared(const std::vector<std::uint32_t>& ids, const CrowdState& crowd, const Crowd& of) {
  return std::ranges::all_of(ids, [&](std::uint32_t id) {
    const std::size_t agent = std::size_t{id} - 1 - of.first;  // beyond all where it is a body's
    if (agent >= of.size()) return false;
    const AgentGroup& group = of.groups[of.group[agent]];
    return agent < group.first + group.count - crowd.waiting[of.group[agent]];
  });
}

/// Whether those in line have places 1 to as many as they are. Expects that all are on their way.
bool are_in_line(const State& state, const Scene& scene) {
  const Crowd& of = scene.crowd;
  std::vector<std::vector<std::uint32_t>> places(of.queues.size());
  for (std::size_t row = 0; row < state.crowd.place.size(); ++row) {
    const Leg& leg = of.leg(agent_of(scene, state, of.first + row), state.crowd.stage[row]);
    if (leg.kind == Leg::Kind::queue && state.crowd.place[row] > 0)
      places[leg.options[state.crowd.option[row]]].push_back(state.crowd.place[row]);
  }
  for (std::vector<std::uint32_t>& queue : places) {
    std::ranges::sort(queue);
    for (std::size_t i = 0; i < queue.size(); ++i)
      if (queue[i] != i + 1) return false;
  }
  return true;
}

/// Whether only dynamic bodies sleep, at rest, and their islands have names; the contacts that sleep are
/// between bodies that there are.
bool sleeps_soundly(const State& state, const Scene& scene) {
  const SleepState& sleep = state.sleep;
  const std::size_t n = plan_for(scene).sleep ? scene.bodies.size() : 0;
  if (sleep.calm.size() != n || sleep.squared_speed.size() != n || sleep.island.size() != n) return false;
  for (std::size_t row = 0; row < n; ++row) {
    const std::uint32_t island = sleep.island[row];
    if (island == 0) continue;
    if (island > n || sleep.island[island - 1] != island || state.id[row] != row + 1 ||
        scene.bodies.kind[row] != BodyKind::dynamic || state.velocity[row] != Vec(0.0, 0.0) ||
        state.spin[row] != 0.0)
      return false;
  }
  const auto sound = [&](const SleepingContact& contact) {
    return contact.island >= 1 && contact.island <= n && sleep.island[contact.island - 1] == contact.island &&
           contact.a >= 1 && contact.a <= n && contact.b <= n;
  };
  return std::ranges::all_of(sleep.disc_contacts, sound) && std::ranges::all_of(sleep.point_contacts, sound);
}

}  // namespace

bool fits(const State& state, const Scene& scene) {
  const CrowdState& crowd = state.crowd;
  const Crowd& of = scene.crowd;
  const bool agents = of.size() > 0;
  const std::size_t rows = state.id.size(), arrived = static_cast<std::size_t>(crowd.arrived);
  if (state.sensed.size() != scene.sensors.size() || rows + arrived + waiting(crowd) != scene.bodies.size() ||
      (agents && rows < of.first) || crowd.stand.size() != (agents ? rows - of.first : 0) ||
      crowd.waiting.size() != (agents ? of.groups.size() : 0) ||
      crowd.measured.size() != (agents ? of.measures.size() : 0) || (arrived > 0 && !agents) ||
      (!crowd.on_line.empty() && crowd.on_line.back().line >= crowd.measured.size()))
    return false;
  if (!sleeps_soundly(state, scene)) return false;
  for (std::size_t group = 0; group < crowd.waiting.size(); ++group)
    if (crowd.waiting[group] > (of.groups[group].entrance ? of.groups[group].count : 0)) return false;
  for (std::size_t row = 0; agents && row < of.first; ++row)
    if (state.id[row] != row + 1) return false;
  for (std::size_t row = 0; row < crowd.stage.size(); ++row)
    if (!is_on_its_way(state, scene, row)) return false;
  if (!have_appeared(crowd.arrived_id, crowd, of)) return false;
  return are_in_line(state, scene);
}

namespace {

/// The sum of the hashes of so many bodies, from row `first` on.
template <std::size_t rows>
std::uint64_t sum_of_hashes(const State& state, std::size_t first) {
  std::array<std::uint64_t, rows> one;
  one.fill(0x7468726f6e673032ULL);
  const auto add = [&](auto word) {
    for (std::size_t k = 0; k < rows; ++k) one[k] = mix(one[k], word(first + k));
  };
  add([&](std::size_t row) { return state.id[row]; });
  add([&](std::size_t row) { return bits(state.position[row].x()); });
  add([&](std::size_t row) { return bits(state.position[row].y()); });
  add([&](std::size_t row) { return bits(state.angle[row]); });
  add([&](std::size_t row) { return bits(state.velocity[row].x()); });
  add([&](std::size_t row) { return bits(state.velocity[row].y()); });
  add([&](std::size_t row) { return bits(state.spin[row]); });
  std::uint64_t sum = 0;
  for (std::uint64_t each : one) sum += finished(each);
  return sum;
}

}  // namespace

/// Four bodies at a time: each word of one waits for the word before.
std::uint64_t hash(const State& state) {
  std::uint64_t sum = 0;
  std::size_t row = 0;
  for (; row + 4 <= state.id.size(); row += 4) sum += sum_of_hashes<4>(state, row);
  for (; row < state.id.size(); ++row) sum += sum_of_hashes<1>(state, row);
  return finished(mix(mix(sum, state.id.size()), static_cast<std::uint64_t>(state.step)));
}

}  // namespace throng
